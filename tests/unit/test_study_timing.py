# SPDX-License-Identifier: MIT
"""Medians and quartiles of repeats, and their order."""

from __future__ import annotations

import math

from usersub.study import points, timing
from usersub.study.stamp import stamp


def test_spread_is_median_and_quartiles():
    assert timing.spread([5.0, 1.0, 3.0, 2.0, 4.0]) == (3.0, 2.0, 4.0)
    assert timing.spread([1.0, 2.0]) == (1.5, 1.25, 1.75)
    assert timing.spread([7.0]) == (7.0, 7.0, 7.0)
    assert all(map(math.isnan, timing.spread([])))
    assert timing.spread([math.nan, 7.0]) == (7.0, 7.0, 7.0)


def test_repeats_come_in_turns_and_what_is_done_is_left_out():
    some = points(["P3"], languages=["c"])[:3]
    done = {some[0].key: 1, some[1].key: 2}
    rounds = []
    for waiting in timing.turns(some, done, 2):
        rounds.append([some.index(p) for p in waiting])
        for point in waiting:
            done[point.key] = done.get(point.key, 0) + 1
    assert rounds == [[2], [0, 2]]
    assert not list(timing.turns(some, done, 2))


def test_stamp_names_machine_and_versions():
    found = stamp()
    assert {"machine", "usersub", "Python", "numpy", "C compiler"} <= set(found)
    assert all(isinstance(text, str) and text for text in found.values())
