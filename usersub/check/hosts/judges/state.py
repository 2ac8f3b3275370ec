# SPDX-License-Identifier: MIT
"""State variables: what a routine left for a point is what the point brings back.

The probe leaves numbers that tell the call, the point and the component, so that a wrong one says
where it came from."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator

import numpy as np

from usersub.check.hosts.evidence import Evidence, Followed, number, place, same_bits
from usersub.check.hosts.history import Analysis, Attempt, entries
from usersub.check.hosts.log import Call
from usersub.check.hosts.motion import keys_of
from usersub.check.hosts.rule import HISTORY, host_rule
from usersub.check.rule import CannotCheck, NotApplicable

_COUNTS = {"fric": "NSTATV", "vfric": "nStateVar", "vfriction": "nStates"}


@host_rule(
    "host.state",
    "State variables on entry are those that the point had at the end of the accepted increment "
    "before, also in later iterations and after a cut-back; no point gets those of another.",
    reference="FRIC, VFRIC, VFRICTION: state variables are updated by the routine; that iterations "
    "restart from the values at the start of the increment is assumed",
    hint="Keep committed and trial state apart: copy the committed state of the point before every "
    "call, and take the trial state over when the increment is accepted.",
    interfaces=("fric", "fric_coef", "vfric", "vfriction"),
    needs=HISTORY,
)
def state(evidence: Evidence) -> Iterator[str]:
    """By the way in which the interface keeps state."""
    calls = evidence.need_calls()
    if all(_states(c) == 0 for c in calls):
        raise NotApplicable("the host gives the interaction no state variables")
    judge = {"fric": _fric, "fric_coef": _fric_coef, "vfric": _vfric, "vfriction": _vfriction}
    seen = []
    for analysis in evidence.analyses:
        found, compared = judge[evidence.interface](analysis)
        if found:
            yield found
            return
        seen.append(compared)
    if not any(seen):
        raise CannotCheck("no point came back in a later call")


def _states(call: Call) -> int:
    if call.face.key == "fric_coef_2022":
        flags = call.array("iData")
        return 0 if flags is None else int(flags[4])
    name = _COUNTS.get(call.face.key)
    return (call[name] or 0) if name else 0


def _came_from(calls: Iterable[Call], name: str, value: float) -> tuple[Call, int] | None:
    """The last of the calls that returned `value` in its state variables, and where in them."""
    for call in reversed(list(calls)):
        left = call.answer(name)
        if left is None:
            continue
        at = np.flatnonzero(np.ravel(left, order="F") == value)
        if at.size:
            return call, int(at[0])
    return None


def _before(analysis: Analysis, call: Call) -> list[Call]:
    calls = [c for attempt in analysis.attempts for c in attempt.calls]
    return [c for c in calls if c.sequence < call.sequence]


def _differs(now: np.ndarray, allowed: list[np.ndarray]) -> tuple[int, float, float] | None:
    """Where state variables are none of those allowed: index from 0, value, expected value."""
    if any(same_bits(now, one) for one in allowed):
        return None
    flat, kept = np.ravel(now, order="F"), np.ravel(allowed[0], order="F")
    if flat.shape != kept.shape:
        return None  # another number of them: host.counts
    at = int(np.flatnonzero(flat != kept)[0])
    return at, float(flat[at]), float(kept[at])


def _sentence(
    analysis: Analysis,
    call: Call,
    name: str,
    found: tuple[int, float, float],
    more: str,
) -> str:
    at, value, expected = found
    came = _came_from(_before(analysis, call), name, value)
    which = f", which was returned in {place(came[0])}" if came else ""
    return (
        f"{name}({at + 1}) = {number(value)} on entry{which}; expected {number(expected)}; "
        f"{place(call)}{more}"
    )


def _fric(analysis: Analysis) -> tuple[str | None, bool]:
    committed: dict[Hashable, list[np.ndarray]] = {}
    base: Attempt | None = None
    compared = False
    for entry in entries(analysis):
        if entry.attempt.base is not base:
            base = entry.attempt.base
            if base is not None:
                _commit(base, committed)
        now = entry.call.array("STATEV")
        if now is None:
            continue
        allowed = committed.setdefault(entry.key, [now])
        compared |= allowed[0] is not now
        found = _differs(now, allowed)
        if found:
            more = f", iteration {entry.iteration}"
            return _sentence(analysis, entry.call, "STATEV", found, more), True
    return None, compared


def _commit(base: Attempt, committed: dict[Hashable, list[np.ndarray]]) -> None:
    iterations = base.iterations()
    for iteration in iterations:
        for key, call in iteration.items():
            values, start = call.answer("STATEV"), call.array("STATEV")
            if values is None or start is None:
                continue
            # A point that opened later in the increment may have lost what it was left.
            committed[key] = [values] if key in iterations[-1] else [values, start]


def _fric_coef(analysis: Analysis) -> tuple[str | None, bool]:
    committed: dict[Hashable, list[np.ndarray]] = {}
    compared = False
    base: Attempt | None = None
    for attempt in analysis.attempts:
        if attempt.base is not None and attempt.base is not base:
            base = attempt.base
            committed.update(_last_answers(base))
        for call in attempt.calls:
            data, flags = call.array("rData"), call.array("iData")
            if data is None or flags is None or len(data) < 8:
                continue
            node = int(flags[3])
            compared |= node in committed
            allowed = committed.setdefault(node, [data[7:]])
            found = _differs(data[7:], allowed)
            if found:
                found = (found[0] + 7, *found[1:])
                return _sentence(analysis, call, "rData", found, ""), True
    return None, compared


def _last_answers(base: Attempt) -> dict[Hashable, list[np.ndarray]]:
    """By node, the answers of the last iteration: the host's solution belongs to one of them."""
    last: dict[int, int] = {}
    found: list[tuple[int, int, np.ndarray]] = []
    for call in base.calls:
        data, flags = call.answer("rData"), call.array("iData")
        if data is None or flags is None or len(data) < 8:
            continue
        iteration, node = int(flags[2]), int(flags[3])
        last[node] = max(last.get(node, 0), iteration)
        found.append((node, iteration, data[7:]))
    made: dict[Hashable, list[np.ndarray]] = {}
    for node, iteration, values in found:
        if iteration == last[node]:
            made.setdefault(node, []).append(values)
    return made


def _vfric(analysis: Analysis) -> tuple[str | None, bool]:
    kept: np.ndarray | None = None
    compared = False
    for attempt in analysis.attempts:
        for call in attempt.calls:
            now, after = call.array("statev"), call.answer("statev")
            if now is None or not now.size:
                continue
            if kept is not None and kept.shape == now.shape:
                compared = True
                if not same_bits(now, kept):
                    return _nodal(analysis, call, now, kept), True
            kept = after
    return None, compared


def _nodal(analysis: Analysis, call: Call, now: np.ndarray, kept: np.ndarray) -> str:
    """VFRIC keeps the state variables of all nodes in one array."""
    s, node = (int(i) for i in np.argwhere(now != kept)[0])
    value = float(now[s, node])
    came = _came_from(_before(analysis, call), "statev", value)
    which = ""
    if came:
        there = came[1] // now.shape[0]
        what = f"statev({came[1] % now.shape[0] + 1},{there + 1})"
        which = f", which was returned as {what} in {place(came[0])}"
    return (
        f"statev({s + 1},{node + 1}) = {number(value)} on entry{which}; expected "
        f"{number(float(kept[s, node]))}; {place(call)}"
    )


def _vfriction(analysis: Analysis) -> tuple[str | None, bool]:
    kept: dict[Hashable, list[np.ndarray]] = {}
    compared = False
    followed = Followed()
    for attempt in analysis.attempts:
        fresh: dict[Hashable, list[np.ndarray]] = {}
        for call in attempt.calls:
            now, after = call.array("state"), call.answer("state")
            nodes = call.array("jConSecUid")
            if now is None or not now.size or nodes is None:
                continue
            keys = keys_of(nodes)
            for k in followed.among(keys):
                mine, known = now[:, :, k], kept.get(keys[k])
                compared |= known is not None
                # A node may have several points at a time, at a corner: any of them counts.
                found = _differs(mine, known) if known is not None else None
                if found:
                    return _of_point(analysis, call, k, keys, found), True
                fresh.setdefault(keys[k], []).append(after[:, :, k])
        kept.update(fresh)
    return None, compared


def _of_point(
    analysis: Analysis,
    call: Call,
    k: int,
    keys: list[Hashable],
    found: tuple[int, float, float],
) -> str:
    _, value, expected = found
    came = _came_from(_before(analysis, call), "state", value)
    which = ""
    if came:
        left = came[0].answer("state")
        theirs = keys_of(came[0].array("jConSecUid"))[came[1] // (left.shape[0] * left.shape[1])]
        which = f", which was returned for node {_nodes(theirs)} in {place(came[0])}"
    return (
        f"the point {k + 1} of node {_nodes(keys[k])} has the state variable {number(value)} on "
        f"entry{which}; expected {number(expected)}; {place(call)}"
    )


def _nodes(key: Hashable) -> str:
    return " and ".join(map(str, key)) if isinstance(key, tuple) else str(key)
