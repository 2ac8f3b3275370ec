# SPDX-License-Identifier: MIT
"""LM, TAULM and DSLIP over iterations and increments of FRIC."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.check.hosts.evidence import Evidence, number, place, same_bits, vector
from usersub.check.hosts.history import Entry, entries
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import HISTORY, host_rule

_FRIC = ("fric",)
#: Condition of a point in the increment before, by the LM that its routine returned last. A point
#: without friction has slipped; hosts may also keep the 2 for it.
_CONDITIONS = {0: {0}, 1: {1}, 2: {0, 2}}
_WORDS = {0: "slipping", 1: "sticking", 2: "open or frictionless"}


def returned(call: Call) -> int:
    """LM that the probe returned."""
    return int(call.answer("LM").reshape(-1)[0])


def condition(entry: Entry) -> set[int]:
    """What LM may be at the start of the increment of an entry."""
    if entry.start is not None:
        return _CONDITIONS[returned(entry.start)]
    return {2} if entry.was_open else {0, 1, 2}


@host_rule(
    "host.multiplier",
    "LM, DSLIP and TAULM on entry follow the protocol: LM is what the routine returned in the "
    "iteration before, at the start of an increment the condition of the increment before; DSLIP "
    "is the routine's own after LM = 0 and else zero; TAULM is zero unless LM is 1.",
    reference="FRIC, manual page: LM and DSLIP; TAULM and zero DSLIP in the first iteration are "
    "assumed",
    hint="Keep LM and DSLIP of every point over the iterations, and the condition of every point "
    "(0 slipping, 1 sticking, 2 open) over the increments.",
    interfaces=_FRIC,
    needs=HISTORY,
)
def multiplier(evidence: Evidence) -> Iterator[str]:
    """LM first, since the others are read with it."""
    evidence.need_calls()
    later = begun_anew = False
    for analysis in evidence.analyses:
        for entry in entries(analysis):
            later |= entry.iteration > 1
            if begins_anew(entry):
                begun_anew = True
                continue
            found = _lm(entry) or _dslip(entry) or _taulm(entry)
            if found:
                yield f"{found}; {place(entry.call)}, iteration {entry.iteration}"
                return
    if begun_anew:
        evidence.say(
            "some increments were begun anew with the same times, or LM and DSLIP were not handed "
            "on to a later iteration; the two look alike"
        )
    if not later:
        evidence.say("every increment had one iteration, so that LM was not seen to be handed on")
    seen = {returned(c) for c in evidence.calls}
    for lm in (1, 2):
        if lm not in seen:
            evidence.say(f"LM = {lm} was never returned (scenario multiplier)")


def begins_anew(entry: Entry) -> bool:
    """Whether a later iteration could be the first one of another attempt with the same times: it
    is not what the iteration before asks for, but what the first one began with."""
    before = entry.previous
    if before is None:
        return False
    call, lm = entry.call, returned(before)
    own = before.answer("DSLIP") if lm == 0 else None
    dslip = call.array("DSLIP")
    handed_on = call["LM"] == lm and (own is None or dslip is None or same_bits(dslip, own))
    if handed_on:
        return False
    return (
        call["LM"] == entry.first["LM"]
        and _is_zero(call, "DSLIP")
        and (call["LM"] == 1 or _is_zero(call, "TAULM"))
    )


def _lm(entry: Entry) -> str | None:
    lm = entry.call["LM"]
    if lm is None:
        return None
    if lm not in (0, 1, 2):
        return f"LM = {lm} on entry; expected 0, 1 or 2"
    if entry.previous is not None:
        before = returned(entry.previous)
        if lm == before:
            return None
        return (
            f"LM = {lm} on entry, but the routine had returned {before} in the iteration before; "
            "expected that"
        )
    if entry.iteration > 1 and entry.start is None and not entry.was_open:
        return None  # it closed in this increment, and nothing is known of the one before
    allowed = condition(entry)
    if lm in allowed or (lm == 2 and _is_zero(entry.call, "TAU")):
        return None  # in the second case it opened in an iteration that cannot be seen
    if entry.start is None:
        return (
            f"LM = {lm} ({_WORDS[lm]}) on entry for a point that had no call in the last iteration "
            "of the increment before; expected 2 (open)"
        )
    return (
        f"LM = {lm} on entry, but the routine had returned {returned(entry.start)} at the end of "
        f"the increment before; expected {' or '.join(map(str, sorted(allowed)))}"
    )


def _dslip(entry: Entry) -> str | None:
    now = entry.call.array("DSLIP")
    if now is None:
        return None
    if entry.previous is None:
        if _is_zero(entry.call, "DSLIP"):
            return None
        return f"DSLIP = {vector(now)} on entry of the first iteration; expected zero"
    if returned(entry.previous) != 0:
        if _is_zero(entry.call, "DSLIP"):
            return None
        return (
            f"DSLIP = {vector(now)} on entry, although the routine returned LM = "
            f"{returned(entry.previous)} in the iteration before; expected zero"
        )
    own = entry.previous.answer("DSLIP")
    if same_bits(now, own):
        return None
    return (
        f"DSLIP = {vector(now)} on entry, but the routine had returned {vector(own)} with LM = 0 "
        "in the iteration before; expected its own values"
    )


def _taulm(entry: Entry) -> str | None:
    now = entry.call.array("TAULM")
    if now is None or entry.call["LM"] == 1 or not np.any(now):
        return None
    return (
        f"TAULM = {vector(now)} on entry with LM = {entry.call['LM']}; expected zero, since only a "
        "point that sticks (LM = 1) has constraint stresses"
    )


def _is_zero(call: Call, name: str) -> bool:
    values = call.array(name)
    return values is None or not np.any(values)


@host_rule(
    "host.sticking",
    "A point whose routine returns LM = 1 does not move.",
    reference="FRIC, manual page: LM = 1 on return means no relative motion; the host enforces it "
    "with Lagrange multipliers; a bench that prescribes the slip cannot",
    severity="warning",
    hint="Add the constraint, or end with a message when a routine returns LM = 1.",
    interfaces=_FRIC,
    needs=HISTORY,
)
def sticking(evidence: Evidence) -> Iterator[str]:
    """Accepted increments in which LM = 1 was returned throughout: the last slip increment."""
    from usersub.check.rule import CannotCheck

    evidence.need_calls()
    seen = False
    largest: dict = {}
    for call in evidence.calls:
        slip = call.array("DGAM")
        if slip is not None and slip.size:
            key = (call.scenario, call.process, call["NODE"], call["NOEL"])
            largest[key] = max(largest.get(key, 0.0), float(np.abs(slip).max()))
    for analysis in evidence.analyses:
        held = {a.base for a in analysis.attempts if a.base is not None}
        for attempt in analysis.attempts:
            iterations = attempt.iterations()
            if attempt not in held or len(iterations) < 2:
                continue
            for point, call in iterations[-1].items():
                lms = [returned(i[point]) for i in iterations[:-1] if point in i]
                slip = call.array("DGAM")
                if set(lms) != {1} or slip is None:
                    continue
                seen = True
                moved = float(np.abs(slip).max())
                most = largest[(call.scenario, call.process, call["NODE"], call["NOEL"])]
                if moved > 1e-6 * most:
                    yield (
                        f"DGAM = {vector(slip)} in the last iteration, although the routine "
                        "returned LM = 1 in all of them; expected no motion (the largest "
                        f"increment of this point is {number(most)}); {place(call)}"
                    )
                    return
    if not seen:
        raise CannotCheck(_why_not(evidence))


def _why_not(evidence: Evidence) -> str:
    if all(returned(call) != 1 for call in evidence.calls):
        return "LM = 1 was never returned, since the host did not come to the increments of that"
    run = evidence.of("multiplier")
    if run is not None and run.code != 0:
        return f"after LM = 1 the host {run.ending}"
    return "no accepted increment had a second iteration after LM = 1"
