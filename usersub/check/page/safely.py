# SPDX-License-Identifier: MIT
"""Numbers of figures from child processes, so that a routine that crashes ends no page."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from usersub.check.page.figures import Data, Refused
from usersub.check.running import isolate

if TYPE_CHECKING:
    from usersub.check.running.inside import Channel

#: Seconds for one figure, and for all of a page.
_FIGURE, _PAGE = 4.0, 20.0


@dataclass(frozen=True)
class Tried:
    """What came of running the routine.

    Attributes:
        data: pieces that arrived, in order.
        reason: why there is nothing, or no more; "".
    """

    data: tuple[Data, ...] = ()
    reason: str = ""


class Budget:
    """Time that a page may spend on running routines."""

    def __init__(self, seconds: float = _PAGE) -> None:
        self._end = time.monotonic() + seconds

    def tried(self, works: dict[str, Callable[[], Any]]) -> dict[str, Tried]:
        """Does every work in a child process: each gives data, or yields several pieces of it."""
        left = self._end - time.monotonic()
        if left <= 0:
            why = "could not be drawn: the routine took too long in the figures before"
            return dict.fromkeys(works, Tried(reason=why))
        seconds = min(_FIGURE, left)
        jobs = ((name, _said(work), seconds) for name, work in works.items())
        workers = min(len(works), os.cpu_count() or 1)
        found = {key: _judged(outcome) for key, outcome in isolate.run_all(jobs, workers)}
        return {name: found[name] for name in works}


def _said(work: Callable[[], Any]) -> isolate.Work:
    def run(child: Channel) -> None:
        try:
            made = work()
            for piece in [made] if isinstance(made, dict) else made:
                child.say({"piece": piece})
        except Refused as refused:
            child.say({"refused": str(refused)})

    return run


def _judged(outcome: isolate.Outcome) -> Tried:
    pieces = tuple(m["piece"] for m in outcome.said if "piece" in m)
    for message in outcome.said:
        if "refused" in message:
            return Tried(pieces, message["refused"])
        if "error" in message:
            return Tried(pieces, f"could not be drawn: {message['error']['words']}")
    how = {
        isolate.EXITED: f"ended the process with exit code {outcome.code}",
        isolate.SIGNALLED: f"crashed ({outcome.signal_name})",
        isolate.TIME: "did not return in time",
    }.get(outcome.how)
    return Tried(pieces, f"could not be drawn: the routine {how}" if how else "")
