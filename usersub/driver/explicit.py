# SPDX-License-Identifier: MIT
"""The explicit driver: VFRIC, VFRICTION and VFRIC_COEF, one call an increment."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from usersub.core import lib
from usersub.driver.base import Driver


class ExplicitResponse(NamedTuple):
    """What one increment gives.

    Attributes:
        force: friction force on the secondary side of each point, global components, shape (D, N).
        coefficient: friction coefficient, shape (N,) (VFRIC_COEF), else None.
        dissipation: frictional dissipation so far (scene setting `dissipation`), else 0.
    """

    force: np.ndarray
    coefficient: np.ndarray | None
    dissipation: float


class ExplicitDriver(Driver):
    """VFRIC, VFRICTION or VFRIC_COEF: local axes, rotation, routine, forces on both surfaces."""

    kind = "explicit"
    interfaces = ("vfric", "vfriction", "vfric_coef")
    _c_call = "usub_step"

    @property
    def elastic_energy(self) -> float:
        """Elastic energy of all points (VFRIC_COEF by penalty enforcement), else 0.

        It belongs to the last increment and to the areas that are bound now.
        """
        return lib.usub_elastic_energy(self._handle)

    def _plan_notes(self) -> tuple[str, ...]:
        scene, coefficient = self.scene, "coefficient" in self.layout.ports
        penalty = scene["enforcement"] == "penalty" or (coefficient and scene["stick_slope"] > 0.0)
        slope = f"stiffness {scene['stick_slope']:g} times area"
        notes = []
        if scene["enforcement"] == "kinematic":
            notes.append("kinematic: the driver computes the stick force from the mass")
        elif penalty and coefficient:
            viscous = f", damping {scene['damping']:g}" if scene["damping"] else ""
            notes.append(f"penalty: the driver keeps the elastic slip, {slope}{viscous}")
        elif penalty:
            notes.append(f"penalty: the driver computes the stick force, {slope}")
        else:
            notes.append("stick force: the host's")
        if scene["shear_limit"]:
            notes.append(f"limit on the shear stress: {scene['shear_limit']:g}")
        return tuple(notes)

    def step(
        self,
        time_increment: float,
        *,
        step_time: float | None = None,
        total_time: float | None = None,
        step: int = 1,
        increment: int | None = None,
        friction_work: float | None = None,
        **arrays: np.ndarray | None,
    ) -> ExplicitResponse:
        """One increment, after binding `arrays`; times are those at its end.

        Args:
            friction_work: frictional dissipation of the whole model that the routine is told.

        Raises:
            SceneError: an array is missing or holds a value that is refused.
            RoutineError: the routine failed. The driver's state is as before.
        """
        self._enter()
        try:
            if arrays:
                self.bind(**arrays)
            self._set_time(step, increment, (time_increment, step_time, total_time))
            if friction_work is not None:
                self._check(lib.usub_set_friction_work(self._handle, float(friction_work)))
            self._finish(lib.usub_step(self._handle))
            self._clock.accept()
            coefficient = (
                self._result("coefficient") if "coefficient" in self.layout.ports else None
            )
            dissipation = lib.usub_dissipation(self._handle)
            return ExplicitResponse(self._result("force"), coefficient, dissipation)  # type: ignore[arg-type]
        finally:
            self._lock.release()
