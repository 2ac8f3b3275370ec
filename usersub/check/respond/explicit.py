# SPDX-License-Identifier: MIT
"""Cases of VFRIC, VFRICTION, and VFRIC_COEF with enforcement, through the explicit driver."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.respond.answer import Answer
from usersub.check.respond.run import Run
from usersub.driver.explicit import ExplicitDriver
from usersub.driver.scene import Scene

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject

#: Stick force over normal force where a case gives none: more than any friction.
AMPLE = 50.0


class ExplicitRun(Run):
    """Points on a plane that is inclined to all coordinate directions."""

    driver: ExplicitDriver

    def __init__(self, subject: Subject, case: Case, options: dict[str, Any]) -> None:
        super().__init__(subject, case, options)
        self.dimension = case.directions + 1
        self.surfaces = subject.interface.name == "vfric"
        if subject.interface.name == "vfric_coef":
            options = {"states": 0, **options}
        n, edges = case.points, 2 if case.contact == "edge-to-edge" else 1
        own: dict[str, Any] = {"dimension": self.dimension, "contact": case.contact}
        corners = 4
        if self.surfaces:
            self.secondary, self.main = n + 2, corners + 1
            own |= {"secondary_nodes": self.secondary, "main_nodes": self.main}
        else:
            self.secondary, self.main = n * edges, corners
            own["nodes"] = self.secondary + self.main
        assert subject.routine is not None
        self.driver = ExplicitDriver(subject.routine, Scene(**self.settings(**own)))
        self.basis, self.normal = _plane(self.dimension, case.angle)
        self.driver.bind(**self._fixed())
        self._initial_state()

    def step(self, index: int) -> Answer:
        step, driver = self.case.steps[index], self.driver
        motion = np.array(step.motion, dtype=float).T
        load = np.array(step.load, dtype=float)
        # Nothing stops a point that does not move.
        moves = np.any(motion != 0.0, axis=0)
        stick = np.where(moves, AMPLE * np.abs(load), 0.0)
        if step.stick is not None:
            stick = np.array(step.stick, dtype=float)
        arrays = {
            "slip_increment": self.basis @ motion,
            "normal_force": load,
            "stick_force": stick,
            **self._surroundings(step),
        }
        analytical = self.case.contact == "analytical-rigid"
        one = {"temperature_main", "field_main"} if analytical else set()
        put = self._put(**{k: v for k, v in arrays.items() if k not in one})
        for name in one & set(arrays):
            put[name] = np.asfortranarray(arrays[name][..., :1], dtype=self.real)
        if step.area is not None:
            put["area"] = self._area(np.array(step.area, dtype=float))
        response = driver.step(step.dt, step=self.step_number(index), **put)
        force = np.asarray(response.force, dtype=float)
        state = driver.state["state"] if "state" in driver.state else None
        if state is not None and self.surfaces:
            state = state[..., np.array(driver.array("secondary_node")) - 1]
        return Answer(
            friction=-(self.basis.T @ self._back(force)),
            coefficient=self._back(response.coefficient),
            state=self._back(state),
        )

    # Arrays that stay as they are. Every node and point has its own numbers.

    def _fixed(self) -> dict[str, np.ndarray]:
        n, shapes = self.case.points, self.driver.layout.shapes
        made: dict[str, np.ndarray] = {
            "normal": np.tile(self.normal[:, None], (1, n)).astype(self.real),
            "area": self._area(1.0 + 0.125 * np.arange(n)),
            "shape_main": _shares(shapes["shape_main"], self.real),
        }
        if self.surfaces:
            made |= self._of_surfaces()
        else:
            made |= self._of_points(shapes)
        return {k: np.asfortranarray(v) for k, v in made.items() if v.size and k in shapes}

    def _area(self, per_point: np.ndarray) -> np.ndarray:
        if not self.surfaces:
            return per_point[self.order].astype(self.real)
        whole = np.full(self.secondary, 7.0, dtype=self.real)
        whole[self._secondary_of_point() - 1] = per_point
        return whole

    def _secondary_of_point(self) -> np.ndarray:
        """Surface node of each point of the case: backwards, so that no index is the point's."""
        return self.case.points + 1 - np.arange(self.case.points)

    def _of_surfaces(self) -> dict[str, np.ndarray]:
        n, shape = self.case.points, self.driver.layout.shapes["main_node"]
        facet = np.arange(shape[0])[:, None] + np.zeros((1, n), dtype=int)
        return {
            "secondary_node": self._secondary_of_point()[self.order].astype(np.int32),
            "main_node": (1 + facet % self.main).astype(np.int32),
            "secondary_number": (1001 + 3 * np.arange(self.secondary)).astype(np.int32),
            "main_number": (2001 + 3 * np.arange(self.main)).astype(np.int32),
            "coord_secondary": _places(self.dimension, self.secondary, 0.0, self.real),
            "coord_main": _places(self.dimension, self.main, 0.5, self.real),
        }

    def _of_points(self, shapes: dict[str, tuple[int, ...]]) -> dict[str, np.ndarray]:
        edges, n = shapes["secondary_node"]
        per_point = 1 + np.arange(n * edges).reshape((n, edges)).T
        corners, columns = shapes["main_node"]
        main = self.secondary + 1 + np.arange(corners)[:, None] + np.zeros((1, columns), dtype=int)
        nodes = self.secondary + self.main
        return {
            "secondary_node": per_point[:, self.order].astype(np.int32),
            "main_node": main.astype(np.int32),
            "shape_secondary": _shares(shapes["shape_secondary"], self.real),
            "coord": _places(self.dimension, nodes, 0.25, self.real),
            "velocity": _places(self.dimension, nodes, 0.75, self.real),
        }


def _plane(dimension: int, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Tangential directions (D, F), turned by `angle`, and unit normal (D,) of the plane."""
    if dimension == 2:
        normal = np.array([0.6, 0.8])
        return np.array([[0.8], [-0.6]]), normal
    normal = np.array([2.0, -3.0, 6.0]) / 7.0
    first = np.array([6.0, 2.0, -1.0]) / np.sqrt(41.0)
    first = first - normal * (first @ normal)
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * first + s * second, c * second - s * first]).T, normal


def _shares(shape: tuple[int, ...], real: type) -> np.ndarray:
    """Shape functions: different at every node, with sum one."""
    corners, columns = shape
    weights = np.arange(1, corners + 1, dtype=float)[:, None] + np.zeros((1, columns))
    return np.asfortranarray(weights / max(weights[:, :1].sum(), 1.0), dtype=real)


def _places(dimension: int, count: int, offset: float, real: type) -> np.ndarray:
    """Coordinates or velocities that differ in every component of every node."""
    numbers = np.arange(dimension * count, dtype=float).reshape((dimension, count), order="F")
    return np.asfortranarray(offset + 0.01 * numbers, dtype=real)
