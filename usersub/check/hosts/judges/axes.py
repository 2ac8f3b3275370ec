# SPDX-License-Identifier: MIT
"""Local axes, and the slip in them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.check.hosts import motion
from usersub.check.hosts.evidence import Evidence, number, place, vector
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import FORCE, SIZES, host_rule

#: Far above rounding in either precision, far below a mistake.
_UNIT = {False: 1e-6, True: 1e-4}
#: Cosine above which two directions are the same, below which they are across.
_SAME, _ACROSS = 0.9, 0.1
#: Cosine below which two directions oppose each other, whatever turns within an increment.
_OPPOSITE = -0.9
#: For directions that are made of the same numbers.
_DIRECTION = {False: 1e-5, True: 1e-2}


@host_rule(
    "host.axes",
    "The normal and local direction 1 have unit length and are orthogonal; DROT is a rotation.",
    reference="VFRIC, VFRICTION, manual pages: local coordinate system (VFRIC passes dirCosSl "
    "before dircosN, VFRICTION dircosN before dircosSl); FRIC: DROT is a rotation increment "
    "(assumed)",
    hint="Project the slip on the plane of the unit normal of the main surface, divide by its "
    "length, and pass three (in the plane two) components a point, one point after the other.",
    interfaces=("fric", "fric_coef", *FORCE),
    needs=SIZES,
)
def axes(evidence: Evidence) -> Iterator[str]:
    """Lengths and angles; then whether the two arrays are exchanged."""
    for call in evidence.need_calls():
        found = _rotation(call) if call.face.solver == "standard" else _directions(call)
        if found:
            yield f"{found}; {place(call)}"
            return
    if evidence.interface in FORCE:
        exchanged = _exchanged(evidence)
        if exchanged:
            yield exchanged


def _directions(call: Call) -> str | None:
    found = motion.directions(call)
    if found is None:
        return None
    t1, n = found
    near = _UNIT[call.single]
    for name, vectors in (("dircosN", n), ("dirCosSl", t1)):
        lengths = np.linalg.norm(vectors, axis=0)
        bad = np.abs(lengths - 1) > near
        if bad.any():
            k = int(np.flatnonzero(bad)[0])
            return (
                f"{name}(:,{k + 1}) = {vector(vectors[:, k])} has length {number(lengths[k])}; "
                "expected 1"
            )
    cosine = np.sum(t1 * n, axis=0)
    bad = np.abs(cosine) > near
    if bad.any():
        k = int(np.flatnonzero(bad)[0])
        return (
            f"dirCosSl(:,{k + 1}) = {vector(t1[:, k])} and dircosN(:,{k + 1}) = "
            f"{vector(n[:, k])} have the scalar product {number(cosine[k])}; expected 0"
        )
    return None


def _rotation(call: Call) -> str | None:
    if call.face.key == "fric":
        turn, name = call.array("DROT"), "DROT"
    elif call.face.key == "fric_coef_2022":
        data = call.array("rData")
        turn = None if data is None else data[3:7].reshape(2, 2, order="F")
        name = "rData(4) to rData(7)"
    else:
        return None
    if turn is None:
        return None
    if np.abs(turn.T @ turn - np.eye(2)).max() > _UNIT[False] or np.linalg.det(turn) < 0:
        return (
            f"{name} = {vector(turn.T)} (by columns) is not a rotation; expected the unit matrix "
            "where nothing turns"
        )
    return None


def _exchanged(evidence: Evidence) -> str | None:
    """The motion lies in the plane of direction 1, not along the normal."""
    for path in motion.paths(evidence):
        for now, moved in path.steps():
            size = float(np.linalg.norm(moved))
            if not 0.5 * now.slip < size < 2 * now.slip:
                continue
            if abs(moved @ now.n) > _SAME * size and abs(moved @ now.t1) < _ACROSS * size:
                return (
                    f"contact point {now.index + 1} moves by {vector(moved)} against the main "
                    f"surface, along dircosN(:,{now.index + 1}) = {vector(now.n)} and across "
                    f"dirCosSl(:,{now.index + 1}) = {vector(now.t1)}; the two arrays look "
                    f"exchanged; {place(now.call)}"
                )
    return None


@host_rule(
    "host.slip-direction",
    "The slip increment has one component, along direction 1, and it is not negative; direction 1 "
    "points along the slip of the secondary against the main surface.",
    reference="VFRIC, VFRICTION, manual pages: t1 = ds/|ds|",
    hint="Take ds as the motion of the secondary surface relative to the main surface, pass its "
    "length as the first component of dSlipFric and zero in the others.",
    interfaces=FORCE,
    needs=(*SIZES, "host.axes"),
)
def slip_direction(evidence: Evidence) -> Iterator[str]:
    """Components; then the motion that velocities or coordinates tell."""
    for call in evidence.need_calls():
        slip = call.array("dSlipFric")
        if slip is None or not slip.size:
            continue
        found = _components(slip)
        if found:
            yield f"{found}; {place(call)}"
            return
    against = _against_motion(evidence)
    if against:
        yield against


def _components(slip: np.ndarray) -> str | None:
    negative = slip[0] < 0
    if negative.any():
        k = int(np.flatnonzero(negative)[0])
        return f"dSlipFric(1,{k + 1}) = {number(float(slip[0, k]))}; expected 0 or more"
    other = np.abs(slip[1:]) > 0
    if other.any():
        d, k = (int(i) for i in np.argwhere(other)[0])
        return f"dSlipFric({d + 2},{k + 1}) = {number(float(slip[d + 1, k]))}; expected 0"
    return None


def _against_motion(evidence: Evidence) -> str | None:
    known = False
    for path in motion.paths(evidence):
        for now, moved in path.steps():
            along = moved - now.n * (moved @ now.n)
            size = float(np.linalg.norm(along))
            # Half to twice the slip: the motion that the slip was made of, or that before.
            if not 0.5 * now.slip < size < 2 * now.slip:
                continue
            known = True
            if float(along @ now.t1) < _OPPOSITE * size:
                return _points_elsewhere(now, along, "against")
        lag = path.lag()
        for now, moved in path.steps(lag) if lag is not None else ():
            along = moved - now.n * (moved @ now.n)
            size = float(np.linalg.norm(along))
            if np.abs(along / size - now.t1).max() > _DIRECTION[now.call.single]:
                return _points_elsewhere(now, along, "not along")
    if not known:
        evidence.say(
            "the host gives no velocities or coordinates that tell the slip, so that the direction "
            "of t1 was not compared with it"
        )
    return None


def _points_elsewhere(now: motion.Step, along: np.ndarray, how: str) -> str:
    return (
        f"contact point {now.index + 1} moves by {vector(along)} along the main surface, but "
        f"dirCosSl(:,{now.index + 1}) = {vector(now.t1)} points {how} that; {place(now.call)}"
    )
