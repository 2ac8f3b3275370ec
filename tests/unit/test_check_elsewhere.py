# SPDX-License-Identifier: MIT
"""A fresh process answers from what was there when it was made, and may die."""

from __future__ import annotations

import os

from usersub.check.probing.elsewhere import FreshProcess


def test_it_does_not_know_what_came_later() -> None:
    kept = [1]
    with FreshProcess(lambda more: (kept, more)) as fresh:
        kept.append(2)
        assert fresh.finish("asked") == ([1], "asked")


def test_one_that_dies_answers_nothing() -> None:
    with FreshProcess(lambda _: os._exit(3)) as fresh:
        assert fresh.finish(0) is None


def test_one_that_is_not_asked_ends() -> None:
    with FreshProcess(lambda _: None) as fresh:
        child = fresh._child
    assert not os.path.exists(f"/proc/{child}") or fresh._child == child
    with FreshProcess(lambda _: 7) as second:
        assert second.finish(0) == 7
