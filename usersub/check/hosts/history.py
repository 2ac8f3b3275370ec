# SPDX-License-Identifier: MIT
"""The history that recorded calls tell: analyses, attempts at increments, iterations, points.

Calls of one interaction with one clock are one attempt at an increment. A next attempt with a later
number has accepted the one before; one with the same number has cut it back. A number that goes
back begins a new analysis. Within an attempt a new iteration begins when a point comes again.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass, field

from usersub.check.hosts.clock import Clock, clock, tolerance
from usersub.check.hosts.log import Call

#: How an attempt follows the one before it.
FIRST, ACCEPTED, CUT_BACK = "first", "accepted", "cut back"


@dataclass(eq=False)
class Attempt:
    """Calls with one clock: an attempt at an increment.

    Attributes:
        clock: of all its calls.
        follows: how it follows the one before: FIRST, ACCEPTED (that one was) or CUT_BACK.
        calls: in their order.
        before: the attempt before in the same analysis.
        base: last accepted attempt, whose results this one starts from.
    """

    clock: Clock
    follows: str
    calls: list[Call] = field(default_factory=list)
    before: Attempt | None = None
    base: Attempt | None = None

    def iterations(self) -> list[dict[Hashable, Call]]:
        """FRIC: the calls of each iteration by point."""
        made: list[dict[Hashable, Call]] = [{}]
        for call in self.calls:
            key = point_of(call)
            if key in made[-1]:
                made.append({})
            made[-1][key] = call
        return made


@dataclass(eq=False)
class Analysis:
    """The attempts of one interaction in one analysis."""

    attempts: list[Attempt] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class Entry:
    """A call of FRIC, and what it continues.

    Attributes:
        call, key: the call and its point.
        attempt, iteration: where it is; iterations count from 1.
        first: call of the point in the first iteration of the attempt that has one; the call
            itself in that iteration.
        previous: call of the point in the iteration before, None in the first iteration or if the
            point was not called in it.
        start: last call of the point in the accepted increment before, if its last iteration had
            one; None if it had none (`was_open`) or if there is no such increment.
        was_open: whether the point had no call in the last iteration of the increment before.
    """

    call: Call
    key: Hashable
    attempt: Attempt
    iteration: int
    first: Call
    previous: Call | None
    start: Call | None
    was_open: bool


def point_of(call: Call) -> Hashable:
    """What tells contact points of FRIC and FRIC_COEF apart; None where nothing does."""
    if call.face.key == "fric":
        return call["NOEL"], call["NPT"], call["NODE"]
    flags = call.array("iData") if call.face.key == "fric_coef_2022" else None
    return None if flags is None else int(flags[3])


def analyses(calls: Iterable[Call]) -> list[Analysis]:
    """Sorts calls by interaction and cuts them into analyses and attempts."""
    streams: dict[Hashable, list[Call]] = {}
    for call in calls:
        key = (call.scenario, call.process, call.face.key, call.single, call.names)
        streams.setdefault(key, []).append(call)
    return [analysis for stream in streams.values() for analysis in _analyses(stream)]


def _analyses(stream: list[Call]) -> Iterator[Analysis]:
    made = Analysis()
    for call in stream:
        now = clock(call)
        if now is None:
            continue
        last = made.attempts[-1] if made.attempts else None
        if last is not None and last.clock == now:
            last.calls.append(call)
            continue
        if last is not None and now.number < last.clock.number:
            yield made
            made, last = Analysis(), None
        follows = FIRST if last is None else _relation(last, now, call)
        attempt = Attempt(now, follows, [call], last)
        if last is not None:
            attempt.base = last if follows == ACCEPTED else last.base
        made.attempts.append(attempt)
    if made.attempts:
        yield made


def _relation(last: Attempt, now: Clock, call: Call) -> str:
    if now.number > last.clock.number:
        return ACCEPTED
    # The same number: time tells whether the host went on without counting.
    near = tolerance(call, [last.clock, now])
    went_on = abs(now.start - last.clock.total_time) <= near
    stayed = abs(now.start - last.clock.start) <= near
    return ACCEPTED if went_on and not stayed else CUT_BACK


def entries(analysis: Analysis) -> Iterator[Entry]:
    """FRIC: every call with what it continues."""
    for attempt in analysis.attempts:
        start: dict[Hashable, Call] = {}
        known = attempt.base is not None
        if attempt.base is not None and not _has_gap(attempt):
            start = attempt.base.iterations()[-1]
        before: dict[Hashable, Call] = {}
        firsts: dict[Hashable, Call] = {}
        for number, iteration in enumerate(attempt.iterations(), 1):
            for key, call in iteration.items():
                kept = start.get(key)
                yield Entry(
                    call,
                    key,
                    attempt,
                    number,
                    firsts.setdefault(key, call),
                    before.get(key),
                    kept,
                    known and kept is None,
                )
            before = iteration


def _has_gap(attempt: Attempt) -> bool:
    """Whether increments without calls, in which everything was open, lie before the attempt."""
    return attempt.base is not None and not is_next(attempt.base.clock, attempt)


def is_next(before: Clock, attempt: Attempt) -> bool:
    """Whether an attempt is at the increment that follows `before`. How many increments a step had
    is not known: time tells whether another step began there."""
    now = attempt.clock
    if now.step == before.step:
        return now.increment == before.increment + 1
    near = tolerance(attempt.calls[0], [before, now])
    return now.increment == 1 and now.start <= before.total_time + near
