# SPDX-License-Identifier: MIT
"""Whether NaN in the input of one contact point reaches other points of the same call."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from usersub.check.probing.raw import RawCall, point_axis
from usersub.check.rule import Finding
from usersub.check.rules.words import values

#: Inputs of a point that results may depend on, and the results.
INPUTS = {
    "fric": ("DGAM", "PRESS", "TEMP", "PREDEF"),
    "fric_coef": ("slipRate", "slipData", "pressure", "tempAvg", "fieldAvg"),
    "vfric": ("fNormal", "dSlipFric", "fStickForce", "tempSlv", "preDefSlv"),
    "vfriction": ("fNormal", "dSlipFric", "fStickForce", "areaCont", "tempSlv", "fieldSlv"),
    "vfric_coef": ("slipRate", "pressure", "tempAvg", "fieldAvg"),
}


def coupled(call: RawCall, argument: str, plain: dict[str, np.ndarray]) -> bool:
    """Whether ordinary numbers in one point change other points."""
    point = call.points // 2
    modern = call.face.args[call.face.position(argument)].modern
    others = [k for k in range(call.points) if k != point]
    for factor in (2.0, 0.0):
        call.restore()
        call.point(point)[modern][...] *= factor
        if call.run_apart().how == "returned" and unlike_point(call, plain, call.outputs(), others):
            return True
    return False


def spread(call: RawCall, argument: str, plain: dict[str, np.ndarray]) -> Finding | None:
    """What NaN in one argument of the middle point does elsewhere."""
    point = call.points // 2
    modern = call.face.args[call.face.position(argument)].modern
    call.restore()
    call.point(point)[modern][...] = math.nan
    ended = call.run_apart()
    words = {"crashed": f"crashes ({ended.words})", "time": "does not return"}.get(ended.how)
    if words is not None:
        return Finding(
            f"the routine {words} if {modern} is NaN",
            hint="Leave loops where numbers are not finite, and make no indices of them.",
        )
    if ended.how != "returned":
        return None
    others = [k for k in range(call.points) if k != point]
    unlike = unlike_point(call, plain, call.outputs(), others)
    if unlike is None:
        return _borrowed(call, argument, modern)
    name, k = unlike
    before, after = (_of_point(call, outputs, name, k) for outputs in (plain, call.outputs()))
    return Finding(
        f"NaN in {modern} of point {point + 1} changes {name} of point {k + 1} from "
        f"{values(before)} to {values(after)}",
        hint="Compute each point from its own input alone.",
    )


def _borrowed(call: RawCall, argument: str, modern: str) -> Finding | None:
    """Whether the point with NaN answers with the input of another point."""
    if call.points == 1:
        return None
    point, before = call.points // 2, call.outputs()
    call.restore()
    for other in INPUTS[call.face.name]:
        if other in call and call[other].size:
            call[other] = call[other] * _ELSEWHERE
    call.point(point)[modern][...] = math.nan
    others = [a for a in INPUTS[call.face.name] if a in call and a != argument]
    for other in others:
        own = call.face.args[call.face.position(other)].modern
        if own in call.point(point):
            call.point(point)[own][...] /= _ELSEWHERE
    if call.run_apart().how != "returned":
        return None
    unlike = unlike_point(call, before, call.outputs(), [point])
    if unlike is None:
        return None
    one, two = (_of_point(call, o, unlike[0], point) for o in (before, call.outputs()))
    return Finding(
        f"NaN in {modern} of point {point + 1} gives {unlike[0]} = {values(one)} there, and "
        f"{values(two)} if the other points have other inputs: it is the answer of another point",
        hint="Compute each point from its own input alone.",
    )


#: Factor for the inputs of other points; exact, so that it can be taken back.
_ELSEWHERE = 2.0


def outputs_of(call: RawCall) -> dict[str, np.ndarray] | None:
    """What an ordinary call gives; None if it does not return."""
    call.restore()
    return call.outputs() if call.run_apart().how == "returned" else None


def unlike_point(
    call: RawCall,
    ones: dict[str, np.ndarray],
    others: dict[str, np.ndarray] | None,
    points: Iterable[int],
) -> tuple[str, int] | None:
    """Output and point of the first difference in some of the points."""
    if others is None:
        return "", 0
    for name in ones:
        for k in points:
            one, other = (_of_point(call, outputs, name, k) for outputs in (ones, others))
            if not np.array_equal(one, other, equal_nan=True):
                return name, k
    return None


def _of_point(call: RawCall, outputs: dict[str, np.ndarray], name: str, k: int) -> np.ndarray:
    """The part of an output that belongs to a point; all of it where it belongs to none."""
    axis = point_axis(call.face.args[call.face.position(name)])
    array = outputs[name]
    if axis is None or array.shape[axis] != call.points:
        return array if call.points == 1 else array[:0]
    return np.take(array, k, axis=axis)
