# SPDX-License-Identifier: MIT
"""What FRIC continues from: stress, energy, slip and pressure of the accepted increment."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator

import numpy as np

from usersub.check.hosts.evidence import Evidence, number, place, vector
from usersub.check.hosts.history import Analysis, Attempt, Entry, entries
from usersub.check.hosts.judges.multiplier import returned
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import HISTORY, host_rule

_FRIC = ("fric",)
#: For sums that the host makes.
_RELATIVE = 1e-9
_IDENTITY = np.eye(2)


@host_rule(
    "host.outputs-used",
    "What the routine returned in the last iteration of an accepted increment is what the next "
    "increment starts from: TAU, SED, and SLIP with DSLIP added.",
    reference="FRIC, manual page: TAU, SED, DSLIP and SLIP; that TAU is the value at the start of "
    "the increment in all its iterations is assumed",
    hint="Keep TAU, SED and DSLIP of the accepted increment for every point, and pass them on "
    "entry of every iteration of the next.",
    interfaces=_FRIC,
    needs=HISTORY,
)
def outputs_used(evidence: Evidence) -> Iterator[str]:
    """Start of the increment, the same in all its iterations."""
    evidence.need_calls()
    continued = False
    for analysis in evidence.analyses:
        for entry in entries(analysis):
            continued |= entry.start is not None
            found = _stress(entry) or _energy(entry) or _slip(entry)
            if found:
                yield f"{found}; {place(entry.call)}, iteration {entry.iteration}"
                return
        found = _changes(analysis)
        if found:
            yield found
            return
    if not continued:
        evidence.say("no point was closed in two increments, so that nothing was handed on")


def _stress(entry: Entry) -> str | None:
    now = entry.call.array("TAU")
    if now is None or entry.start is None:
        return None
    before = returned(entry.start)
    kept = entry.start.answer("TAU")
    if before == 1 or (entry.call["LM"] == 2 and not np.any(now)):
        return None  # of a constraint only the host knows the stress; or it opened unseen
    if before == 2:
        kept = np.zeros_like(kept)
    if _same_vector(entry.call, now, kept):
        return None
    what = "but the increment before ended with"
    if entry.previous is not None and _near(now, entry.previous.answer("TAU")):
        what = "which is what the iteration before returned; the increment before ended with"
    return f"TAU = {vector(now)} on entry, {what} {vector(kept)}; expected that"


def _same_vector(call: Call, now: np.ndarray, kept: np.ndarray) -> bool:
    """Directions that turn turn the vector with them; its length stays."""
    turn = call.array("DROT")
    if turn is None or np.abs(turn - _IDENTITY).max() < 1e-12:
        return _near(now, kept)
    return _near(np.linalg.norm(now), np.linalg.norm(kept))


def _near(one, two) -> bool:
    return bool(np.all(np.abs(one - two) <= _RELATIVE * np.abs(two)))


def _energy(entry: Entry) -> str | None:
    now = entry.call["SED"]
    if now is None or entry.start is None or returned(entry.start) != 0:
        return None
    kept = float(entry.start.answer("SED").reshape(-1)[0])
    if _near(now, kept) or (entry.call["LM"] == 2 and now == 0):
        return None
    return (
        f"SED = {number(now)} on entry, but the increment before ended with {number(kept)}; "
        "expected that"
    )


def _slip(entry: Entry) -> str | None:
    now = entry.call.array("SLIP")
    if now is None or entry.start is None:
        return None
    old = entry.start.array("SLIP")
    if old is None:
        return None
    if returned(entry.start) == 2:
        return None  # whether motion without friction counts as slip is not documented
    more = entry.start.answer("DSLIP") if returned(entry.start) == 0 else np.zeros_like(old)
    # A sum of slips to and fro may be far smaller than they are.
    room = 1e-12 * float(np.abs(old).max() + np.abs(more).max())
    if np.abs(now - old - more).max() <= room or _same_vector(entry.call, now, old + more):
        return None
    what = vector(old + more)
    if _near(now, old):
        what += ", with DSLIP added"
    return f"SLIP = {vector(now)} on entry, expected {what}"


_STARTS = ("TAU", "SED", "SLIP")


def _changes(analysis: Analysis) -> str | None:
    """Points of which nothing earlier is known: all iterations have to start from the same."""
    for attempt in analysis.attempts:
        first: dict[Hashable, Call] = {}
        for number_of, iteration in enumerate(attempt.iterations(), 1):
            for key, call in iteration.items():
                begun = first.setdefault(key, call)
                for name in _STARTS:
                    now, then = call.array(name), begun.array(name)
                    if now is None or then is None or _near(now, then):
                        continue
                    if call["LM"] in (1, 2) or returned(begun) != 0:
                        continue  # it opened or sticks: told above where it can be known
                    return (
                        f"{name} = {vector(now)} on entry of iteration {number_of}, but "
                        f"{vector(then)} in the first; expected the value at the start of the "
                        f"increment; {place(call)}"
                    )
    return None


@host_rule(
    "host.pressure",
    "DPRESS is the change of PRESS since the accepted increment before.",
    reference="FRIC: meaning of PRESS (end of the increment) and DPRESS is read from their names "
    "(assumed)",
    hint="Pass the pressure of this iteration, and its difference to that of the accepted "
    "increment.",
    interfaces=_FRIC,
    needs=HISTORY,
)
def pressure(evidence: Evidence) -> Iterator[str]:
    """Points that were closed in the increment before."""
    evidence.need_calls()
    yield from _first(evidence, _dpress)
    values = {c["PRESS"] for c in evidence.calls}
    if len(values) == 1:
        evidence.say("the pressure was the same in all calls")


def _dpress(entry: Entry) -> str | None:
    change, now = entry.call["DPRESS"], entry.call["PRESS"]
    if entry.start is None or change is None or now is None or entry.start["PRESS"] is None:
        return None
    before = entry.start["PRESS"]
    scale = max(abs(now), abs(before))
    if abs(change - (now - before)) <= 1e-6 * scale:
        return None
    if entry.call["LM"] == 2 and abs(change - now) <= 1e-6 * scale:
        return None  # it opened in an iteration that cannot be seen
    return (
        f"DPRESS = {number(change)} with PRESS = {number(now)}, which was {number(before)} at the "
        f"end of the increment before; expected {number(now - before)}"
    )


def _first(evidence: Evidence, judge: Callable[[Entry], str | None]) -> Iterator[str]:
    for analysis in evidence.analyses:
        for entry in entries(analysis):
            found = judge(entry)
            if found:
                yield f"{found}; {place(entry.call)}, iteration {entry.iteration}"
                return


@host_rule(
    "host.iterations",
    "Iteration numbers begin at 1 in every attempt at an increment and do not go back.",
    reference="FRIC_COEF, manual page of the 2022 form: iData(3)",
    hint="Set iData(3) to 1 in the first iteration of every increment, also after a cut-back.",
    interfaces=("fric_coef",),
    needs=("host.increments",),
)
def iterations(evidence: Evidence) -> Iterator[str]:
    """The number that the newer form of FRIC_COEF passes."""
    from usersub.check.rule import NotApplicable

    calls = evidence.need_calls()
    if all(c.face.key != "fric_coef_2022" for c in calls):
        raise NotApplicable("the legacy form of FRIC_COEF has no iteration number")
    for analysis in evidence.analyses:
        for attempt in analysis.attempts:
            found = _numbers(attempt)
            if found:
                yield found
                return


def _numbers(attempt: Attempt) -> str | None:
    last: dict[Hashable, int] = {}
    smallest = None
    for call in attempt.calls:
        flags = call.array("iData")
        if flags is None:
            continue
        now, node = int(flags[2]), int(flags[3])
        if now < 1:
            return f"iData(3) = {now}; expected 1 or more; {place(call)}"
        if 1 < now < last.get(node, now):  # back to 1 begins another attempt
            return f"iData(3) = {now} after {last[node]} in one increment; {place(call)}"
        last[node] = now
        smallest = now if smallest is None else min(smallest, now)
    if smallest is not None and smallest > 1:
        return (
            f"iData(3) = {smallest} is the smallest in its increment; expected 1 in the first "
            f"iteration; {place(attempt.calls[0])}"
        )
    return None
