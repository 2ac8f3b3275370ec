# SPDX-License-Identifier: MIT
"""The rubbing mass of P5 to P8 in an implicit host, through FRIC or FRIC_COEF.

An increment of sliding is the fixed point of "friction makes the slip, the slip gives the
friction", which takes two or three iterations where the coefficient is constant. Sticking is
equilibrium: of the elastic slip in penalty enforcement, by the multiplier in Lagrange's. Trials are
cut back.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import fixed
from usersub.problems.problem import Stopwatch
from usersub.problems.slider import System
from usersub.problems.slider_explicit import shares_of

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: The mass slides obliquely to the local directions.
_ALONG = np.array([[0.8], [0.6]])

#: Friction counts as found when it changes by less than this share.
_ACCURACY = 1e-14
_ITERATIONS = 60


class ImplicitContact:
    """Friction by FRIC or FRIC_COEF.

    Args:
        static: coefficient at rest, which makes the stiffness of sticking.
        allowable: elastic slip of penalty enforcement.
    """

    def __init__(
        self,
        routine: Routine,
        props: list[float],
        system: System,
        points: int,
        static: float,
        allowable: float,
        enforcement: str = "default",
    ) -> None:
        from usersub import Scene, StandardDriver

        self.lagrange = enforcement == "lagrange"
        by_routine = routine.interface.name == "fric"
        scene = Scene(
            points=points, dimension=3, props=props, states=2 if by_routine else 0,
            enforcement=enforcement, characteristic_length=200.0 * allowable,
        )  # fmt: skip
        self.driver = StandardDriver(routine, scene, reuse=True)
        self.area = shares_of(points)
        self.allowable = allowable
        self.strength = static * system.normal_force
        self.stiffness = self.strength / allowable
        self.slip = np.zeros((2, points), order="F")
        self.multiplier = np.zeros((2, points), order="F")
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        if self.lagrange:
            extra["multiplier"] = self.multiplier
        pressure = np.full(points, system.normal_force)
        self.driver.bind(slip_increment=self.slip, pressure=pressure, **extra)
        self.elastic = self.trial = 0.0
        self.watch = Stopwatch()
        self._close()

    def _close(self) -> None:
        """Closes the contact: its first increment has no friction."""
        self.driver.begin_increment(1.0)
        fixed.iterate(self.driver)
        self.driver.commit()

    def _ask(self, slip: float) -> float:
        """Friction force on the mass after a slip."""
        self.slip[...] = _ALONG * slip
        with self.watch:
            response = fixed.iterate(self.driver)
        return -float((_ALONG * (response.tau * self.area)).sum())

    def _sliding(self, slip: float) -> float:
        """The same for a mass that is known to slide that way.

        With Lagrange multipliers a slip against the last friction means sticking at first, and a
        constraint stress beyond the strength releases.
        """
        force = self._ask(slip)
        if self.lagrange and (self.driver.array("lm") == 1).any():
            self.multiplier[...] = _ALONG * np.copysign(2.0 * self.strength, slip)
            self._ask(0.0)
            force = self._ask(slip)
        return force

    def slide(self, move: Callable[[float], float], rate: float, dt: float, time: float) -> float:
        """Friction force of an increment in which the mass slides."""
        self.driver.begin_increment(dt)
        slip = rate * dt
        force = self._sliding(slip)
        for _ in range(_ITERATIONS):
            slip = move(force)
            if slip * rate <= 0.0:  # not whole; the direction is what counts
                break
            before, force = force, self._sliding(slip)
            if abs(force - before) <= _ACCURACY * abs(force):
                break
        self.trial = np.copysign(self.allowable, rate)
        return force

    def stick(self, load: float, dt: float, time: float) -> float | None:
        """Whether the mass carries `load` by sticking: the elastic motion if it does."""
        self.driver.begin_increment(dt)
        if self.lagrange:
            return self._hold(load)
        self.trial = load / self.stiffness
        moved = self.trial - self.elastic
        self._ask(moved)
        return None if self.driver.array("dslip").any() else moved

    def _hold(self, load: float) -> float | None:
        """By multipliers: a mass that has slipped sticks when it moves against its friction."""
        self.multiplier[...] = _ALONG * load
        force = self._ask(0.0)
        if (self.driver.array("lm") == 0).any():
            self._ask(np.copysign(self.allowable, force))
            self._ask(0.0)
        return 0.0 if (self.driver.array("lm") == 1).all() else None

    def accept(self) -> None:
        """Commits the increment."""
        self.driver.commit()
        self.elastic = self.trial

    def reject(self) -> None:
        """Cuts it back."""
        self.driver.cut_back()
