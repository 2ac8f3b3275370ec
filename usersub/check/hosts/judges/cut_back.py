# SPDX-License-Identifier: MIT
"""PNEWDT: a routine asks for a shorter increment."""

from __future__ import annotations

from collections.abc import Iterator

from usersub.check.hosts.evidence import Evidence, number, place
from usersub.check.hosts.history import ACCEPTED, Attempt
from usersub.check.hosts.rule import host_rule
from usersub.check.rule import CannotCheck

_FRIC = ("fric",)


@host_rule(
    "host.presets",
    "PNEWDT is 1 or more on entry, so that a routine that leaves it alone asks for nothing.",
    reference="FRIC: PNEWDT is preset to a large number (assumed, as in the other routines of the "
    "implicit solver)",
    hint="Set PNEWDT to a large number before every call.",
    interfaces=_FRIC,
)
def presets(evidence: Evidence) -> Iterator[str]:
    """PNEWDT below one."""
    for call in evidence.need_calls():
        value = call["PNEWDT"]
        if value is not None and not value >= 1:
            yield f"PNEWDT = {number(value)} on entry; expected 1 or more; {place(call)}"
            return


@host_rule(
    "host.cut-back",
    "When a routine returns PNEWDT below 1 the increment is abandoned and tried again with at most "
    "that part of its length.",
    reference="FRIC: PNEWDT (assumed to be that of the other routines of the implicit solver)",
    hint="Take the smallest PNEWDT of all calls of an iteration; below 1, forget the increment and "
    "repeat it with PNEWDT times its length.",
    interfaces=_FRIC,
    needs=("host.counts", "host.increments"),
)
def cut_back(evidence: Evidence) -> Iterator[str]:
    """What follows the attempts that were refused."""
    evidence.need_calls()
    run = evidence.of("cut-back")
    if run is None:
        raise CannotCheck("the scenario cut-back was not run")
    judged = False
    for analysis in evidence.analyses:
        for refused, after in zip(analysis.attempts, analysis.attempts[1:], strict=False):
            asked = _asked(refused)
            if asked is None:
                continue
            judged = True
            found = _what_followed(refused, after, asked)
            if found:
                yield f"{found}; {place(after.calls[0])}"
                return
    if not judged:
        asked_at_all = any(_asked(t) is not None for a in evidence.analyses for t in a.attempts)
        raise CannotCheck(
            f"after PNEWDT = 0.5 the host {run.ending}, as one with fixed increments may"
            if asked_at_all
            else "the host did not come to the increment in which the probe asks for a cut-back"
        )


def _asked(attempt: Attempt) -> float | None:
    """Smallest PNEWDT below one that was returned in an attempt."""
    found = []
    for call in attempt.calls:
        answer = call.argument("PNEWDT").answer
        if answer is not None:
            found.append(float(call.answer("PNEWDT").reshape(-1)[0]))
    return min((v for v in found if v < 1), default=None)


def _what_followed(refused: Attempt, after: Attempt, asked: float) -> str | None:
    then, now = refused.clock, after.clock
    if after.follows == ACCEPTED:
        return (
            f"PNEWDT = {number(asked)} was returned in increment {then.increment}, but the host "
            f"went on to increment {now.increment}; expected increment {then.increment} again"
        )
    most = asked * then.time_increment
    if now.time_increment > most * (1 + 1e-6):
        return (
            f"DTIME = {number(now.time_increment)} after PNEWDT = {number(asked)} with DTIME = "
            f"{number(then.time_increment)}; expected at most {number(most)}"
        )
    return None
