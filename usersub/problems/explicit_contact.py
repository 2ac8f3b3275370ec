# SPDX-License-Identifier: MIT
"""A rigid plane under the contact points of an explicit host, through any explicit interface.

The plane is horizontal; its normal points up, to the block: y in two, and in three dimensions
alike. Two-dimensional hosts reach VFRICTION and VFRIC_COEF, which belong to general contact, in
three dimensions with nothing happening along z.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.problem import Stopwatch

if TYPE_CHECKING:
    from usersub.driver.explicit import ExplicitDriver
    from usersub.routine.routine import Routine

_DTYPES = {"double": np.float64, "single": np.float32}

#: How the plane is described to the routine: one facet of four nodes, or an analytical surface.
FACET, ANALYTICAL = "node-to-facet", "analytical-rigid"

#: The rigid facet reaches far beyond the block, in in.
_REACH = 100.0


class ExplicitContact:
    """Friction at contact points on the plane.

    Args:
        routine: VFRIC, VFRICTION or VFRIC_COEF.
        props: its properties.
        coordinates: of the contact points at the start, shape (dimension, points).
        area: of each contact point.
        dimension: of the host's vectors, 2 or 3.
        contact: FACET or ANALYTICAL.
        mass: of each contact point, for kinematic enforcement by the driver.
        settings: further settings of the scene.
    """

    def __init__(
        self,
        routine: Routine,
        props: list[float],
        coordinates: np.ndarray,
        area: np.ndarray,
        *,
        precision: str = "double",
        contact: str = FACET,
        mass: np.ndarray | None = None,
        **settings: object,
    ) -> None:
        from usersub import ExplicitDriver, Scene

        self.host_dimension, self.points = coordinates.shape
        self.general = routine.interface.name != "vfric"
        self.dimension = 3 if self.general else self.host_dimension
        self.real = _DTYPES[precision]
        n = self.points
        corners = 1 if contact == ANALYTICAL else 2 ** (self.dimension - 1)
        sizes = (
            {"nodes": n + corners}
            if self.general
            else {"secondary_nodes": n, "main_nodes": corners}
        )
        scene = Scene(
            points=n, dimension=self.dimension, precision=precision, contact=contact, props=props,
            **sizes, **settings,
        )  # fmt: skip
        self.driver: ExplicitDriver = ExplicitDriver(routine, scene, reuse=True)
        self._bind(contact, corners, coordinates, np.asarray(area), mass)
        self.watch = Stopwatch()

    def _bind(
        self,
        contact: str,
        corners: int,
        coordinates: np.ndarray,
        area: np.ndarray,
        mass: np.ndarray | None,
    ) -> None:
        n, d, real = self.points, self.dimension, self.real
        arrays = {
            "slip_increment": np.zeros((d, n), real, order="F"),
            "normal": np.zeros((d, n), real, order="F"),
            "normal_force": np.zeros(n, real),
            "area": area.astype(real),
        }
        if mass is not None:
            arrays["mass"] = mass.astype(real)
            arrays["predicted_velocity"] = np.zeros((d, n), real, order="F")
        elif "condition" not in self.driver.state:  # else the driver enforces sticking
            arrays["stick_force"] = np.zeros(n, real)
        arrays["normal"][1] = 1.0
        self.coord = np.zeros((d, n + corners), real, order="F")
        self.velocity = np.zeros((d, n + corners), real, order="F")
        self.coord[: self.host_dimension, :n] = coordinates
        # Corners around the plane, in the order of the facet's nodes.
        around = np.array([[-1, 1, 1, -1], [0, 0, 0, 0], [-1, -1, 1, 1]], real)[:d, :corners]
        facet = corners > 1
        if facet:
            self.coord[:, n:] = _REACH * around
        secondary = np.arange(1, n + 1, dtype=np.int32)
        main = np.arange(1, corners + 1, dtype=np.int32)
        if self.general:
            arrays["secondary_node"] = secondary.reshape(1, n, order="F")
            main, arrays["coord"], arrays["velocity"] = main + n, self.coord, self.velocity
        else:
            arrays["secondary_node"] = secondary
            # The driver wants separate arrays of both surfaces; these are views of one memory.
            arrays["coord_secondary"], arrays["coord_main"] = self.coord[:, :n], self.coord[:, n:]
        here = n if facet else 1
        known = self.driver.layout.ports
        if "main_node" in known and (facet or self.general):
            arrays["main_node"] = np.asfortranarray(np.tile(main[:, None], (1, here)))
            self.shape = np.ones((corners, here), real, order="F")
            arrays["shape_main"] = self.shape
            self._around = around if facet else None
        else:
            self._around = None
        self._move_shape()
        self.arrays = {k: v for k, v in arrays.items() if k in known}
        self.driver.bind(**self.arrays)

    def _move_shape(self) -> None:
        """Shape functions of the facet where the points are now."""
        if self._around is None:
            return
        here = self.coord[:, : self.points] / _REACH
        factors = [1.0 + np.outer(self._around[i], here[i]) for i in (0, 2) if i < self.dimension]
        self.shape[...] = np.prod(factors, axis=0) / len(self._around[0])

    def move(self, coordinates: np.ndarray, velocity: np.ndarray) -> None:
        """Tells the routine where the points are and how fast, shapes (dimension, points)."""
        self.coord[: self.host_dimension, : self.points] = coordinates
        self.velocity[: self.host_dimension, : self.points] = velocity
        self._move_shape()

    def force(
        self,
        slip: np.ndarray,
        normal_force: np.ndarray,
        stick_force: np.ndarray | None,
        time_increment: float,
        time: float,
        velocity: np.ndarray | None = None,
    ) -> np.ndarray:
        """Friction force on each contact point, shape (dimension of the host, points).

        Args:
            stick_force: None where the driver enforces sticking.
            velocity: predicted one, for kinematic enforcement by the driver.
        """
        self.arrays["slip_increment"][: self.host_dimension] = slip
        self.arrays["slip_increment"][1] = 0.0
        self.arrays["normal_force"][...] = normal_force
        if stick_force is not None:
            self.arrays["stick_force"][...] = stick_force
        if velocity is not None:
            self.arrays["predicted_velocity"][: self.host_dimension] = velocity
        with self.watch:
            response = self.driver.step(time_increment, step_time=time, total_time=time)
        return response.force[: self.host_dimension].astype(float)


def mean_slip(
    before: np.ndarray,
    predicted: np.ndarray,
    last_friction: np.ndarray,
    mass: np.ndarray,
    time_increment: float,
) -> np.ndarray:
    """Slip increments that the routine is told, along the predicted velocity.

    The predicted velocity lacks the friction that is asked for; a slip rate made of it lags behind
    and a coefficient that depends on it is of first order in time. With the friction of the last
    increment the rate becomes the mean of the increment's two velocities, of second order.

    Args:
        before: velocities of the last increment, shape (dimension, points).
        predicted: velocities without the friction of this increment.
        last_friction: friction of the last increment.
        mass: of each contact point.
    """
    speed = np.linalg.norm(predicted, axis=0)
    middle = 0.5 * (before + predicted + time_increment * last_friction / mass)
    along = np.einsum("ij,ij->j", middle, predicted)
    share = np.divide(along, speed**2, out=np.ones_like(speed), where=speed > 0.0)
    # At rest nothing but the direction counts, and that is the predicted one.
    return predicted * (time_increment * np.clip(share, 1e-3, 1.0))
