# SPDX-License-Identifier: MIT
"""Times, and numbers of steps and increments."""

from __future__ import annotations

import math
from collections.abc import Iterator

from usersub.check.hosts.clock import Clock, clock, names, tolerance
from usersub.check.hosts.evidence import Evidence, number, place
from usersub.check.hosts.history import ACCEPTED, CUT_BACK, FIRST, Attempt
from usersub.check.hosts.rule import host_rule

_END = (
    "times are taken to be those at the end of the increment (assumed; the manual names them only)"
)


@host_rule(
    "host.increments",
    "Steps and increments count from one; an accepted increment is followed by the next number, "
    "one that is cut back by the same.",
    reference="manual pages of the interfaces: step and increment number",
    hint="Count an increment when it is accepted, and begin again at 1 in every step.",
)
def increments(evidence: Evidence) -> Iterator[str]:
    """Numbers below one, numbers that stay although time goes on, numbers that change places."""
    for call in evidence.need_calls():
        now = clock(call)
        if now is None:
            continue
        of = names(call)
        if now.step < 1:
            yield f"{of.step} = {now.step}; expected 1 or more; {place(call)}"
            return
        if now.increment < (1 if call.face.solver == "standard" else 0):
            yield f"{of.increment} = {now.increment}; expected 1 or more; {place(call)}"
            return
    for analysis in evidence.analyses:
        found = _stays(analysis.attempts) or _exchanged(analysis.attempts)
        if found:
            yield found
            return
        for attempt in analysis.attempts:
            found = _jumps(attempt)
            if found:
                yield f"{found}; {place(attempt.calls[0])}"
                return


def _stays(attempts: list[Attempt]) -> str | None:
    for attempt in attempts:
        before = attempt.before
        if before is None or attempt.follows != ACCEPTED:
            continue
        if attempt.clock.number == before.clock.number:
            call = attempt.calls[0]
            return (
                f"{names(call).increment} = {attempt.clock.increment} again, although "
                f"{names(call).total_time} went on from {number(before.clock.total_time)} to "
                f"{number(attempt.clock.total_time)}; expected the next number; {place(call)}"
            )
    return None


def _exchanged(attempts: list[Attempt]) -> str | None:
    """Step numbers that count increments: a step a call, all of them with increment 1."""
    accepted = [a for a in attempts if a.follows != CUT_BACK]
    if len(accepted) < 4:
        return None
    call, clocks = accepted[-1].calls[0], [a.clock for a in accepted]
    one_increment = len({c.increment for c in clocks}) == 1
    steps_run = [c.step for c in clocks] == list(
        range(clocks[0].step, clocks[0].step + len(clocks))
    )
    starts_anew = any(
        abs(c.step_time - c.time_increment) <= tolerance(call, [c]) for c in clocks[1:]
    )
    if one_increment and steps_run and not starts_anew:
        return (
            f"{names(call).step} counts up to {clocks[-1].step} while {names(call).increment} "
            f"stays {clocks[0].increment} and step time goes on; the two numbers look exchanged; "
            f"{place(call)}"
        )
    return None


def _jumps(attempt: Attempt) -> str | None:
    base = attempt.base
    if attempt.follows != ACCEPTED or base is None or base.clock.step != attempt.clock.step:
        return None
    now, then, call = attempt.clock, base.clock, attempt.calls[0]
    near = tolerance(call, [now, then])
    if min(now.time_increment, then.time_increment) <= near:
        return None
    stayed = abs(now.start - then.start) <= near and now.total_time <= then.total_time + near
    if stayed:
        return (
            f"{names(call).increment} = {now.increment} after {then.increment}, although it starts "
            f"at {number(now.start)} like the one before; expected {then.increment} again, since "
            "no time has gone by"
        )
    if now.increment <= then.increment + 1:
        return None
    if abs(now.start - then.total_time) > near:
        return None  # increments without calls lie between
    return (
        f"{names(call).increment} = {now.increment} after {then.increment}, although it starts at "
        f"the time at which that ended; expected {then.increment + 1}"
    )


@host_rule(
    "host.times",
    "Step time, total time and time increment fit one another from increment to increment.",
    reference=f"manual pages of the interfaces: times; {_END}",
    hint="Pass the times at the end of the increment that is being solved, and its own length.",
    needs=("host.increments",),
)
def times(evidence: Evidence) -> Iterator[str]:
    """Each clock alone, the first of a step, and each against the one before."""
    for call in evidence.need_calls():
        now = clock(call)
        if now is None:
            continue
        found = _alone(call, now)
        if found:
            yield f"{found}; {place(call)}"
            return
    for analysis in evidence.analyses:
        for attempt in analysis.attempts:
            found = _first_of_step(attempt) or _against(attempt)
            if found:
                yield f"{found}; {place(attempt.calls[0])}"
                return
    if all(len(a.attempts) < 2 for a in evidence.analyses):
        evidence.say("the host made one increment only, so that times were not seen to go on")


def _alone(call, now: Clock) -> str | None:
    of = names(call)
    if not all(map(math.isfinite, (now.step_time, now.total_time, now.time_increment))):
        return (
            f"{of.step_time}, {of.total_time}, {of.time_increment} = {number(now.step_time)}, "
            f"{number(now.total_time)}, {number(now.time_increment)}; expected finite numbers"
        )
    if now.time_increment < 0:
        return f"{of.time_increment} = {number(now.time_increment)}; expected 0 or more"
    near = tolerance(call, [now])
    if now.total_time < now.step_time - near:
        return (
            f"{of.total_time} = {number(now.total_time)} is less than {of.step_time} = "
            f"{number(now.step_time)}; total time counts from the start of the analysis"
        )
    return None


def _first_of_step(attempt: Attempt) -> str | None:
    now, call = attempt.clock, attempt.calls[0]
    of, near = names(call), tolerance(call, [attempt.clock])
    if now.increment != 1 or now.time_increment <= near:
        return None
    if abs(now.step_time - now.time_increment) <= near:
        return None
    return (
        f"{of.step_time} = {number(now.step_time)} in the first increment of the step, with "
        f"{of.time_increment} = {number(now.time_increment)}; expected the same number, the end of "
        "the increment"
    )


def _against(attempt: Attempt) -> str | None:
    base, now, call = attempt.base, attempt.clock, attempt.calls[0]
    if attempt.follows == FIRST or base is None:
        return None
    of, then = names(call), base.clock
    near = tolerance(call, [now, then])
    if (
        now.step == then.step
        and abs((now.total_time - now.step_time) - (then.total_time - then.step_time)) > 2 * near
    ):
        return (
            f"{of.total_time} - {of.step_time} = {number(now.total_time - now.step_time)}, but "
            f"{number(then.total_time - then.step_time)} in the increment before; expected one "
            "number within a step, the total time at its start"
        )
    if now.step > then.step or now.increment > then.increment + 1:
        # Increments in which everything was open may lie between.
        if now.start < then.total_time - near:
            return _gap(of, now, then, "expected a later start")
        return None
    if abs(now.start - then.total_time) > near:
        return _gap(of, now, then, "expected to start where that ended")
    return None


def _gap(of, now: Clock, then: Clock, expected: str) -> str:
    return (
        f"{of.total_time} = {number(now.total_time)} with {of.time_increment} = "
        f"{number(now.time_increment)} starts at {number(now.start)}, but the increment before "
        f"(number {then.increment}) ended at {number(then.total_time)}; {expected}"
    )
