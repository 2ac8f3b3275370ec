# SPDX-License-Identifier: MIT
"""Contact points that slide, each along its own direction, for hosts that decide on the pressure.

What a host asks is the friction stress along the slip at a pressure, and how it changes with slip
and pressure: the tangents of the standard driver, or a difference of two answers of the explicit
one, which has none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usersub.problems import fixed
from usersub.problems.explicit_contact import ExplicitContact
from usersub.problems.linear_host import make_driver
from usersub.problems.path_host import directions
from usersub.problems.problem import Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Elastic slip of FRIC and FRIC_COEF: nothing against the slip of an increment.
ALLOWABLE = 1e-12

#: Mass of the points in explicit hosts: no friction stops them.
_HEAVY = 1e20


class Answer(NamedTuple):
    """Friction stress along the slip and its derivatives, of the shape (points,)."""

    stress: np.ndarray
    by_slip: np.ndarray
    by_pressure: np.ndarray


class StandardPoints:
    """Through FRIC or FRIC_COEF; in contact when they are made."""

    implicit = True

    def __init__(
        self, routine: Routine, props: list[float], points: int, *, lagrange: bool = False
    ) -> None:
        self.driver = make_driver(
            routine, props, points, directions=2, allowable=ALLOWABLE, lagrange=lagrange
        )
        self.along = directions(points)
        self.slip, self.pressure = np.zeros((2, points), order="F"), np.ones(points)
        self.multiplier = np.zeros((2, points), order="F")
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        if lagrange:
            extra["multiplier"] = self.multiplier
        self.driver.bind(slip_increment=self.slip, pressure=self.pressure, **extra)
        self.driver.begin_increment(1.0)  # closes the contact: no friction yet
        fixed.iterate(self.driver)
        self.driver.commit()
        self.watch = Stopwatch()

    def begin(self, time_increment: float) -> None:
        """Opens an increment."""
        self.driver.begin_increment(time_increment)

    def end(self, *, commit: bool) -> None:
        """Accepts it, or forgets it."""
        (self.driver.commit if commit else self.driver.cut_back)()

    def ask(self, slip: np.ndarray | float, pressure: np.ndarray | float) -> Answer:
        """One iteration of the open increment."""
        self.slip[...], self.pressure[...] = slip * self.along, pressure
        with self.watch:
            found = fixed.iterate(self.driver)
        assert found.ddtddg is not None and found.ddtddp is not None  # the scene has tangents
        n = self.along
        return Answer(
            (found.tau * n).sum(0),
            np.einsum("ak,abk,bk->k", n, found.ddtddg, n),
            (found.ddtddp * n).sum(0),
        )


class ExplicitPoints:
    """Through VFRIC, VFRICTION or VFRIC_COEF, with areas that differ."""

    implicit = False

    def __init__(self, routine: Routine, props: list[float], points: int, precision: str) -> None:
        dimension = 2 if routine.interface.name == "vfric" else 3
        ones = np.ones(points)
        # In a plane, every other point goes the other way.
        flat = np.array([np.where(np.arange(points) % 2, -1.0, 1.0), 0.0 * ones])
        self.along = flat if dimension == 2 else np.insert(directions(points), 1, 0.0, axis=0)
        self.area = 1.0 + 0.5 * np.arange(points) / points
        self.contact = ExplicitContact(
            routine, props, np.zeros((dimension, points), order="F"), self.area,
            precision=precision, mass=_HEAVY * ones, enforcement="kinematic",
        )  # fmt: skip
        self.watch, self.time, self.width = self.contact.watch, 0.0, 1.0

    def begin(self, time_increment: float) -> None:
        """Sets the increment of what is asked next."""
        self.width = time_increment

    def end(self, *, commit: bool) -> None:
        """Goes on in time."""
        self.time += self.width if commit else 0.0

    def stress(self, slip: np.ndarray | float, pressure: np.ndarray | float) -> np.ndarray:
        """Friction stress along the slip; a pressure below zero is none."""
        motion = slip * self.along
        force = self.contact.force(
            motion, np.maximum(pressure, 0.0) * self.area, None, self.width,
            self.time + self.width, motion / self.width,
        )  # fmt: skip
        return -(force * self.along).sum(0) / self.area

    def ask(self, slip: np.ndarray | float, pressure: np.ndarray | float) -> Answer:
        """Stress, and its change between the pressure and twice the pressure."""
        stress = self.stress(slip, pressure)
        change = (self.stress(slip, 2.0 * np.asarray(pressure)) - stress) / pressure
        return Answer(stress, np.zeros_like(stress), change)


def make_points(
    routine: Routine, props: list[float], points: int, precision: str
) -> StandardPoints | ExplicitPoints:
    """Points through the interface of a routine."""
    if routine.interface.name.startswith("v"):
        return ExplicitPoints(routine, props, points, precision)
    return StandardPoints(routine, props, points)
