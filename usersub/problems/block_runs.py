# SPDX-License-Identifier: MIT
"""Runs of the block through any of the five interfaces: what P1 and P2 share."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from usersub.errors import SceneError
from usersub.problems import block_fe, block_implicit, elements, rigid
from usersub.problems.block import Block, Stop
from usersub.problems.explicit_contact import ANALYTICAL, FACET, ExplicitContact
from usersub.problems.problem import Outcome, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

_EXPLICIT_METHODS = ("rigid", "rigid rk4", "CPE3", "C3D8R")
_IMPLICIT_METHODS = ("implicit", "implicit Romberg")

#: Hosts and time integrations by interface.
METHODS = {
    "vfric": _EXPLICIT_METHODS,
    "vfriction": (*_EXPLICIT_METHODS, "CPE3 analytical", "C3D8R analytical"),
    "vfric_coef": _EXPLICIT_METHODS,
    "fric": _IMPLICIT_METHODS,
    "fric_coef": _IMPLICIT_METHODS,
}

OPTIONS = {
    "points": "contact points of the rigid block",
    "steps": "increments until the rigid block stands still, about",
    "step_share": "time increment of the finite-element block over the largest stable one",
    "history": "True to keep time, distance, velocity and friction force",
}

#: Relative errors of time and distance that a finite-element run may have; the time is that of the
#: manual's own finite-element answer.
FE_TOLERANCE = Stop(2.5e-3, 5e-4)

#: Rounding that single precision is allowed.
_SINGLE_TOLERANCE = 1e-6

#: A block that still slides after this many exact stopping times does not stop.
_PATIENCE = 1.5

#: Contact points of the rigid block.
_POINTS = {"explicit": 1024, "implicit": 64}


@dataclass
class BlockRun:
    """One run of the block, compared with the exact answer.

    Attributes:
        problem: name of the problem.
        props: properties of the law.
        tolerance: relative error of the rigid block in double precision.
        steps: increments until the rigid block stands still, about.
        step_share: time increment of the finite-element block over the largest stable one.
        rows: time, distance, velocity, friction force of every increment, or None.
    """

    problem: str
    block: Block
    exact: Stop
    props: list[float]
    tolerance: float
    routine: Routine
    law: str
    precision: str
    method: str
    points: int | None = None
    steps: int = 128
    step_share: float = 0.9
    history: bool = False
    rows: list | None = field(init=False)

    def __post_init__(self) -> None:
        if not self.steps >= 1:
            raise SceneError(f"problem {self.problem}: steps is {self.steps}, expected 1 or more")
        if not 0.0 < self.step_share <= 1.0:
            raise SceneError(
                f"problem {self.problem}: step_share is {self.step_share}, expected a number above "
                "0 and not above 1"
            )
        if self.points is None:
            self.points = _POINTS["implicit" if self.method in _IMPLICIT_METHODS else "explicit"]
        self.rows = [] if self.history else None

    def outcome(self) -> Outcome:
        """Runs and compares."""
        elastic = self.method.startswith("C")
        details: dict[str, float] = {}
        if self.method in _IMPLICIT_METHODS:
            stop, watch, step, details = self._implicit()
        else:
            stop, watch, step = self._finite_elements() if elastic else self._rigid()
        time_error, distance_error = stop.error(self.exact)
        error, what = float(np.max([time_error, distance_error])), "stopping time and distance"
        tolerance = self.tolerance
        if elastic:
            # Weighed with what each may be off, so that one number tells.
            weight = FE_TOLERANCE.time / FE_TOLERANCE.distance
            error = float(np.max([time_error, weight * distance_error]))
            tolerance = FE_TOLERANCE.time
            what = f"stopping time, {weight:.0f} x distance"
        elif self.precision == "single":
            tolerance = max(tolerance, _SINGLE_TOLERANCE)
        return Outcome(
            problem=self.problem, law=self.law, interface=self.routine.interface.name,
            language=self.routine.language, precision=self.precision, method=self.method,
            step=step, points=self.points, error=error, error_of=what, tolerance=tolerance,
            details={
                "time_error": time_error, "distance_error": distance_error,
                "stopping_time": stop.time, "distance": stop.distance, **details,
            },
            history=_columns(self.rows), **watch.times(self.points),
        )  # fmt: skip

    def _rigid(self) -> tuple[Stop, Stopwatch, float]:
        # In three dimensions the block slides obliquely to the axes.
        dimension = 2 if self.routine.interface.name == "vfric" else 3
        direction = np.array([1.0, 0.0] if dimension == 2 else [0.8, 0.0, 0.6])
        contact = ExplicitContact(
            self.routine, self.props,
            rigid.contact_coordinates(self.block, self.points, dimension),
            rigid.contact_areas(self.block, self.points), precision=self.precision,
        )  # fmt: skip
        force = rigid.friction_of(self.block, contact, direction)
        # Not a divisor of the stopping time: the last increment has to be shortened.
        step = self.exact.time / (self.steps - 0.37)
        scheme = rigid.runge_kutta if self.method == "rigid rk4" else rigid.central_differences
        stop = scheme(self.block, force, step, _PATIENCE * self.exact.time, self.rows)
        return stop, contact.watch, step

    def _finite_elements(self) -> tuple[Stop, Stopwatch, float]:
        element, _, plane = self.method.partition(" ")
        make = elements.triangles if element == "CPE3" else elements.hexahedra
        mesh = make(self.block)
        contact = ExplicitContact(
            self.routine, self.props, mesh.coordinates[mesh.bottom].T, mesh.area,
            precision=self.precision, contact=ANALYTICAL if plane else FACET,
        )  # fmt: skip
        self.points = contact.points
        host = block_fe.FiniteElementBlock(self.block, mesh, contact, share=self.step_share)
        stop = host.run(_PATIENCE * self.exact.time, self.rows)
        return stop, contact.watch, host.time_increment

    def _implicit(self) -> tuple[Stop, Stopwatch, float, dict[str, float]]:
        host = block_implicit.ImplicitBlock(self.block, self.routine, self.props, self.points)
        find = host.extrapolated_stop if self.method == "implicit Romberg" else host.stop
        # Any sensible guess does; one that is too early never reverses the block.
        stop = find(0.9 * self.exact.time, self.steps, self.rows)
        details = {"newton_iterations": host.iterations / host.increments}
        return stop, host.watch, self.exact.time / self.steps, details


def _columns(rows: list | None) -> dict[str, np.ndarray] | None:
    if not rows:
        return None
    columns = np.array(rows, float).T
    return dict(zip(("time", "distance", "velocity", "friction_force"), columns, strict=True))
