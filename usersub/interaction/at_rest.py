# SPDX-License-Identifier: MIT
"""What friction would be at points that are open: a change in a step starts from there too."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.driver.coefficient import CoefficientDriver
from usersub.driver.scene import Scene

if TYPE_CHECKING:
    from usersub.interaction.friction import Friction

#: Condition of an open point.
_OPEN = 2


def set_open_points(driver: Any, friction: Friction, amplitude: float) -> None:
    """Sets the committed coefficients of open points to those of `friction` at rest.

    Points that were never closed have none yet, and those that opened have an old one.

    Args:
        driver: of FRIC_COEF, whose friction is `friction`.
        amplitude: how far its friction had changed, 1 where it does not change.
    """
    points = np.flatnonzero(driver.state["condition"] == _OPEN)
    if points.size == 0:
        return
    end = _at_rest(driver.scene, friction, driver._bound, points)
    start = driver.state["start_coefficient"][:, points]
    driver.state["committed_coefficient"][:, points] = (1.0 - amplitude) * start + amplitude * end


def _at_rest(
    scene: Scene, friction: Friction, arrays: Mapping[str, np.ndarray], points: np.ndarray
) -> np.ndarray:
    """Coefficients without slip or pressure, shape (2, points)."""
    kept = {key: scene[key] for key in ("anisotropic", "states", "fields", "temperatures")}
    alone = Scene(points=points.size, props=scene.props, derivatives=1, **kept)
    driver = CoefficientDriver(friction.acting_law(), alone)

    def mean(name: str) -> np.ndarray:
        both = (arrays[f"{name}_{side}"][..., points] for side in ("secondary", "main"))
        return np.asfortranarray(sum(0.5 * array for array in both))

    given: dict[str, Any] = {"slip_data": np.zeros((6, points.size), order="F")}
    given["pressure"] = np.zeros(points.size)
    for name, setting in (("temperature", "temperatures"), ("field", "fields")):
        # A host need not bind what the law does not read.
        if scene[setting] and f"{name}_secondary" in arrays:
            given[name] = mean(name)
    first = driver.evaluate(**given)
    second = driver.array("second_coefficient") if scene["anisotropic"] else first
    return np.array([first, second])
