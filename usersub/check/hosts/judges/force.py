# SPDX-License-Identifier: MIT
"""Forces of VFRIC and VFRICTION: zeroed outputs, normal, stick and previous force."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from dataclasses import dataclass

import numpy as np

from usersub.check.hosts.clock import Clock, clock
from usersub.check.hosts.evidence import Evidence, Followed, number, place, tolerance, vector
from usersub.check.hosts.history import Analysis, Attempt, is_next
from usersub.check.hosts.log import Call
from usersub.check.hosts.motion import directions, keys_of, second
from usersub.check.hosts.rule import FORCE, HISTORY, SIZES, host_rule


@host_rule(
    "host.zeroed-outputs",
    "fTangential is zero on entry.",
    reference="VFRIC, VFRICTION, manual pages: components that the routine does not set stay zero",
    hint="Set fTangential to zero before every call.",
    interfaces=FORCE,
    needs=SIZES,
)
def zeroed_outputs(evidence: Evidence) -> Iterator[str]:
    """What is left of an earlier call."""
    for call in evidence.need_calls():
        values = call.array("fTangential")
        if values is None or not np.any(values != 0):
            continue
        d, k = (int(i) for i in np.argwhere(values != 0)[0])
        yield (
            f"fTangential({d + 1},{k + 1}) = {number(float(values[d, k]))} on entry; expected 0; "
            f"{place(call)}"
        )
        return


@host_rule(
    "host.normal-force",
    "Normal forces and areas are not negative.",
    reference="VFRIC, VFRICTION: published routines multiply fNormal by the coefficient as it is",
    hint="Pass the size of the normal force, positive in compression.",
    interfaces=FORCE,
    needs=SIZES,
)
def normal_force(evidence: Evidence) -> Iterator[str]:
    """Signs."""
    seen = False
    for call in evidence.need_calls():
        area = "areaSec" if call.face.name == "vfric" else "areaCont"
        for name in ("fNormal", area):
            values = call.array(name)
            if values is None:
                continue
            seen |= name == "fNormal" and bool(np.any(values))
            if np.any(values < 0):
                k = int(np.flatnonzero(values < 0)[0])
                yield (
                    f"{name}({k + 1}) = {number(float(values[k]))}; expected 0 or more; "
                    f"{place(call)}"
                )
                return
    if not seen:
        evidence.say("all normal forces were zero")


@dataclass(frozen=True)
class _Point:
    """A contact point in one increment: local axes, slip, forces."""

    call: Call
    clock: Clock
    index: int
    t1: np.ndarray
    t2: np.ndarray
    n: np.ndarray
    slip: float
    stick: float
    previous: np.ndarray
    returned: np.ndarray

    @property
    def force(self) -> np.ndarray:
        """Global components of the force that the probe returned."""
        made = self.returned[0] * self.t1
        return made + self.returned[1] * self.t2 if len(self.returned) > 1 else made

    def local(self, force: np.ndarray) -> np.ndarray:
        """Tangential components of a force in the axes of this increment."""
        return np.array([force @ self.t1, force @ self.t2])[: len(self.returned)]


def _points(call: Call, followed: Followed) -> Iterator[tuple[Hashable, _Point]]:
    """The contact points of a call by node."""
    found, when = directions(call), clock(call)
    arrays = [call.array(name) for name in ("dSlipFric", "fStickForce", "fTangPrev")]
    returned = call.answer("fTangential")
    nodes = call.array("jConSecid" if call.face.name == "vfric" else "jConSecUid")
    if found is None or when is None or nodes is None or returned is None:
        return
    if any(a is None for a in arrays):
        return
    (t1, n), (slip, stick, previous) = found, arrays
    t2 = second(t1, n)
    keys = keys_of(nodes)
    for k in followed.among(keys):
        yield (
            keys[k],
            _Point(
                call,
                when,
                k,
                t1[:, k],
                t2[:, k],
                n[:, k],
                float(slip[0, k]),
                float(stick[k]),
                previous[:, k].astype(float),
                returned[:, k].astype(float),
            ),
        )


def _by_increment(attempt: Attempt, followed: Followed) -> dict[Hashable, list[_Point]]:
    made: dict[Hashable, list[_Point]] = {}
    for call in attempt.calls:
        for key, point in _points(call, followed):
            made.setdefault(key, []).append(point)
    return made


def _histories(analysis: Analysis) -> Iterator[tuple[_Point, _Point | None, bool]]:
    """Every point with itself in the increment before, and whether that increment is known.

    Points whose node has several at a time are left out: nothing tells them apart."""
    before: dict[Hashable, list[_Point]] = {}
    last: Clock | None = None
    followed = Followed()
    for attempt in analysis.attempts:
        now = _by_increment(attempt, followed)
        follows = last is not None and is_next(last, attempt)
        for key, points in now.items():
            older = before.get(key, []) if follows else []
            if len(points) == 1 and len(older) < 2:
                yield points[0], older[0] if older else None, follows
        before, last = now, attempt.clock


@host_rule(
    "host.previous-force",
    "fTangPrev is the friction force of the increment before, in the local axes of this one; zero "
    "for a point that was not in contact.",
    reference="VFRIC, VFRICTION: fTangPrev (axes and zero are assumed)",
    hint="Keep the force of every point in global components, and take its components along t1 and "
    "t2 of the new increment.",
    interfaces=FORCE,
    needs=(*HISTORY, "host.axes", "host.slip-direction"),
)
def previous_force(evidence: Evidence) -> Iterator[str]:
    """Against what the probe returned, turned."""
    evidence.need_calls()
    compared = turned = False
    for analysis in evidence.analyses:
        for now, before, known in _histories(analysis):
            if not known:
                continue
            compared |= before is not None
            turned |= before is not None and float(before.t1 @ now.t1) < 1 - 1e-6
            found = _previous(now, before)
            if found:
                yield f"{found}; {place(now.call)}"
                return
    if not compared:
        evidence.say("no point was in contact in two increments")
    elif not turned:
        evidence.say("local axes never turned, so that the turning of fTangPrev was not seen")


def _previous(now: _Point, before: _Point | None) -> str | None:
    given = now.previous[: len(now.returned)]
    name = f"fTangPrev(:,{now.index + 1}) = {vector(now.previous)}"
    if before is None:
        if not np.any(given):
            return None
        return f"{name} for a point that was not in contact in the increment before; expected zero"
    expected = now.local(before.force)
    size = float(np.linalg.norm(before.force))
    # Hosts turn a force with the normal in different ways.
    lean = float(np.linalg.norm(now.n - before.n))
    room = (100 * tolerance(now.call) + 2 * lean) * size
    if np.abs(given - expected).max() <= room:
        return None
    for what, wrong in (
        ("in the axes of that increment", before.returned),
        ("in global components", before.force[: len(given)]),
        ("with the other sign", -expected),
    ):
        if size > 0 and np.abs(given - wrong).max() <= 1e-6 * size:
            return (
                f"{name} is the force of the increment before {what}; expected {vector(expected)}"
            )
    return f"{name}; expected {vector(expected)}, the force of the increment before"


@host_rule(
    "host.stick-force",
    "The stick force is not negative, and is the force that would stop the slip of this increment.",
    reference="VFRIC, VFRICTION: fStickForce; mass times predicted velocity by time increment "
    "(kinematic) or the elastic trial force (penalty) is assumed",
    hint="Compute it from the slip of this increment: m |ds| / dt^2, or | F_previous - k ds |.",
    interfaces=FORCE,
    needs=(*HISTORY, "host.axes", "host.slip-direction"),
)
def stick_force(evidence: Evidence) -> Iterator[str]:
    """Signs; then which slip it was made of."""
    slid = 0
    largest = 0.0
    for call in evidence.need_calls():
        values, slip = call.array("fStickForce"), call.array("dSlipFric")
        if values is None or slip is None:
            continue
        if np.any(values < 0):
            k = int(np.flatnonzero(values < 0)[0])
            value = number(float(values[k]))
            yield f"fStickForce({k + 1}) = {value}; expected 0 or more; {place(call)}"
            return
        slid += int(np.sum(slip[0] > 0))
        largest = max(largest, float(np.max(values, initial=0.0)))
    if slid and not largest > 0:
        yield (
            f"fStickForce is zero in all calls although points slip in {slid} of them; expected "
            "the force that would stop them, since a force above it is not allowed"
        )
        return
    if not slid:
        evidence.say("no point slipped, so that the size of the stick force was not seen")
        return
    yield from _method(evidence)


def _method(evidence: Evidence) -> Iterator[str]:
    """Whether the stick force goes with the slip of this increment or with that before."""
    tallies = {"now": 0, "before": 0, "neither": 0}
    example = ""
    for analysis in evidence.analyses:
        last: dict[Hashable, tuple[_Point, _Point]] = {}
        for now, before, _ in _histories(analysis):
            key = (now.call.names, now.index)
            older = last.get(key)
            if before is not None:
                if older is not None and older[0] is before:
                    verdict = _fits(now, before, older[1])
                    if verdict:
                        tallies[verdict] += 1
                        if verdict == "before" and not example:
                            example = (
                                f"fStickForce({now.index + 1}) = {number(now.stick)} goes with the "
                                f"slip of the increment before, {number(before.slip)}, and not "
                                f"with that of this one, {number(now.slip)}; {place(now.call)}"
                            )
                last[key] = now, before
    if tallies["before"] > 2 * (tallies["now"] + tallies["neither"]) and tallies["before"] > 2:
        yield example
    elif not tallies["now"]:
        evidence.say(
            "the slips were too uniform, or of another method, to tell which slip the stick force "
            "is made of"
        )


def _fits(now: _Point, before: _Point, older: _Point) -> str:
    """ "now", "before" or "neither", where the slips tell them apart; else ""."""
    near = 1e-6 if not now.call.single else 1e-3
    if min(now.slip, before.slip, older.slip, now.stick, before.stick) <= 0:
        return ""
    if not np.isfinite(now.stick + before.stick):
        return ""
    if abs(now.slip / before.slip - before.slip / older.slip) < 10 * near:
        return ""

    def kinematic(stick: float, slip: float, dt: float) -> float:
        return stick * dt * dt / slip

    def is_same(one: float, two: float) -> bool:
        return abs(one - two) <= near * abs(one)

    dt, dt_before = now.clock.time_increment, before.clock.time_increment
    if is_same(
        kinematic(now.stick, now.slip, dt), kinematic(before.stick, before.slip, dt_before)
    ) or any(is_same(a, b) for a in _stiffness(now) for b in _stiffness(before)):
        return "now"
    if is_same(
        kinematic(now.stick, before.slip, dt), kinematic(before.stick, older.slip, dt_before)
    ):
        return "before"
    return "neither"


def _stiffness(p: _Point) -> list[float]:
    """Penalty stiffnesses k that would give | F_previous - k ds | = stick force."""
    along = p.previous[0]
    across = float(np.sum(p.previous[1 : len(p.returned)] ** 2))
    inside = p.stick**2 - across
    if inside < 0:
        return []
    return [(along + root) / p.slip for root in (np.sqrt(inside), -np.sqrt(inside))]
