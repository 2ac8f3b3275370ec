# SPDX-License-Identifier: MIT
"""Time curves by which friction changes in a step."""

from __future__ import annotations

import math
import numbers
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from usersub.errors import SceneError

Points = Sequence[tuple[float, float]]


def value_at(points: Points, time: float, *, smooth: bool) -> float:
    """A curve at a time: constant outside its points, linear in between or, if `smooth`, with
    neither slope nor curvature at the points."""
    times = [t for t, _ in points]
    after = bisect_right(times, time)
    if after == 0 or after == len(times):
        return points[max(after - 1, 0)][1]
    (t0, v0), (t1, v1) = points[after - 1 : after + 1]
    share = (time - t0) / (t1 - t0)
    if smooth:
        share = share**3 * (10.0 - 15.0 * share + 6.0 * share * share)
    return v0 + (v1 - v0) * share


@dataclass(frozen=True)
class Amplitude:
    """A curve from the old friction (0) to the new one (1) over the time of the step.

    Attributes:
        points: pairs of step time and value: times ascend, values lie in 0 to 1 and never fall.
        smooth: whether it is a smooth step between the points instead of straight lines.

    Raises:
        SceneError: the points are not so; the message names the first that is wrong.
    """

    points: tuple[tuple[float, float], ...]
    smooth: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", _checked(self.points))

    def value(self, time: float) -> float:
        """The curve at a step time, constant before its first and after its last point."""
        return value_at(self.points, time, smooth=self.smooth)


def _checked(points: Points) -> tuple[tuple[float, float], ...]:
    found: list[tuple[float, float]] = []
    for index, point in enumerate(points):
        where = f"amplitude point {index} = {point!r}"
        if not isinstance(point, Sequence) or len(point) != 2:
            raise SceneError(f"{where}; expected a pair of step time and value")
        for number in point:
            real = isinstance(number, numbers.Real) and not isinstance(number, bool)
            if not (real and math.isfinite(number)):
                raise SceneError(f"{where}; expected two finite numbers")
        time, value = float(point[0]), float(point[1])
        if not 0.0 <= value <= 1.0:
            raise SceneError(f"{where}; expected a value in 0 to 1")
        if found and time <= found[-1][0]:
            raise SceneError(f"{where}; expected a time after {found[-1][0]:g}")
        if found and value < found[-1][1]:
            raise SceneError(f"{where}; expected a value of {found[-1][1]:g} or more")
        found.append((time, value))
    if not found:
        raise SceneError("an amplitude has no points; expected pairs of step time and value")
    return tuple(found)
