# SPDX-License-Identifier: MIT
"""Processor time of interleaved rounds, and the rows of the tables."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

ROUNDS = 15
ROUND_SECONDS = 0.02

#: Repeats something a number of times.
Repeat = Callable[[int], None]


@dataclass(frozen=True)
class Row:
    """One measured way to do some work.

    Attributes:
        work: what is done.
        way: by whom: language, peer.
        points: contact points of a call.
        seconds: median of one call.
        limit: what it is compared with; "" for a limit itself or a peer without target.
        limit_seconds: median of that in the same rounds.
        target: largest ratio that is wanted; None where there is no target.
        reason: why the target is missed, if it is.
    """

    work: str
    way: str
    points: int
    seconds: float
    limit: str = ""
    limit_seconds: float = 0.0
    target: float | None = None
    reason: str = ""

    @property
    def ratio(self) -> float:
        """Time over that of the limit."""
        return self.seconds / self.limit_seconds

    @property
    def met(self) -> bool:
        """Whether the ratio, in the digits that are shown, is within the target."""
        return self.target is None or round(self.ratio, 2) <= self.target


def once(repeat: Repeat, times: int) -> float:
    """Seconds of processor time of one call, in a round of `times` calls."""
    start = time.thread_time()
    repeat(times)
    return (time.thread_time() - start) / times


def medians(repeats: dict[str, Repeat], rounds: int = ROUNDS) -> dict[str, float]:
    """Median seconds of one call of each, measured in turns so that all see the same machine."""
    times = {}
    for name, repeat in repeats.items():
        repeat(2)
        times[name] = max(1, int(ROUND_SECONDS / once(repeat, 2)))
    found: dict[str, list[float]] = {name: [] for name in repeats}
    for _ in range(rounds):
        for name, repeat in repeats.items():
            found[name].append(once(repeat, times[name]))
    return {name: statistics.median(seconds) for name, seconds in found.items()}


def calls(function: Callable, *arguments: object) -> Repeat:
    """A function that calls `function` a number of times from Python."""

    def repeat(times: int) -> None:
        for _ in range(times):
            function(*arguments)

    return repeat
