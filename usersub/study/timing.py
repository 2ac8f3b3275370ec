# SPDX-License-Identifier: MIT
"""Times of a study: repeats in turns, and their median and quartiles."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from usersub.study.result import Point

#: Runs of each point; and of a quick study.
REPEATS, QUICK = 5, 3


class Times(NamedTuple):
    """Median and quartiles."""

    median: float
    low: float
    high: float


def spread(times: Sequence[float]) -> Times:
    """Median and quartiles, which lie between the times; nan without any."""
    known = [t for t in times if not math.isnan(t)]
    if not known:
        return Times(math.nan, math.nan, math.nan)
    if len(known) == 1:
        return Times(known[0], known[0], known[0])
    low, middle, high = statistics.quantiles(known, n=4, method="inclusive")
    return Times(middle, low, high)


def turns(points: Sequence[Point], done: Mapping[str, int], repeats: int) -> Iterator[list[Point]]:
    """Rounds of a study: in each, every point that has not had its run yet runs once.

    So the repeats of a point lie far apart, and a machine that is busy for a while makes the
    times of all points worse by the same share, not those of one.

    Args:
        done: runs of earlier sessions, by key.
    """
    for count in range(repeats):
        waiting = [p for p in points if done.get(p.key, 0) <= count]
        if waiting:
            yield waiting
