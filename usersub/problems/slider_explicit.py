# SPDX-License-Identifier: MIT
"""The rubbing mass of P5 to P8 in explicit hosts.

`KinematicContact` asks a driver with kinematic enforcement for friction and sticking at an instant.
`CentralDifferences` is the scheme of explicit solvers, with kinematic enforcement (any explicit
interface) or penalty enforcement (VFRIC_COEF). Several contact points of unequal area share the
mass and its weight.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.explicit_contact import ExplicitContact
from usersub.problems.slider import Event, System

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: At an instant the stick force is so many times the normal force, so that it bounds nothing.
_FAR = 1e3


def shares_of(points: int) -> np.ndarray:
    """Shares of the contact points: all different, in sum one."""
    share = 1.0 + np.arange(points) / points
    return share / share.sum()


class Rubbing:
    """Contact points of the mass; the motion is oblique to the axes in three dimensions."""

    def __init__(
        self,
        routine: Routine,
        props: list[float],
        system: System,
        points: int,
        precision: str,
        enforcement: str,
        **settings: object,
    ) -> None:
        share = shares_of(points)
        self.mass, self.normal_force = system.masses[0], system.normal_force
        dimension = 2 if routine.interface.name == "vfric" else 3
        self.along = np.array([1.0, 0.0] if dimension == 2 else [0.8, 0.0, 0.6])[:, None]
        kinematic = enforcement == "kinematic"
        self.contact = ExplicitContact(
            routine, props, np.zeros((dimension, points), order="F"), share, precision=precision,
            mass=self.mass * share if kinematic else None, enforcement=enforcement, **settings,
        )  # fmt: skip
        self.kinematic, self.share = kinematic, share
        self.condition = self.contact.driver.state["condition"]

    def ask(self, slip: float, velocity: float, dt: float, time: float) -> tuple[float, bool]:
        """Friction force along the motion, and whether all points stick."""
        force = self.contact.force(
            self.along * slip, self.normal_force * self.share, None, dt, time,
            self.along * velocity if self.kinematic else None,
        )  # fmt: skip
        return float((self.along * force).sum()), bool((self.condition == 1).all())


class KinematicContact:
    """Friction at an instant, from a driver with kinematic enforcement."""

    def __init__(self, rubbing: Rubbing) -> None:
        self.rubbing = rubbing

    def slide(self, move: Callable[[float], float], rate: float, dt: float, time: float) -> float:
        """Friction force of a sliding mass: in an increment so short that nothing stops it."""
        rubbing = self.rubbing
        short = rubbing.mass * abs(rate) / (_FAR * rubbing.normal_force)
        return rubbing.ask(rate * short, rate, short, time)[0]

    def stick(self, load: float, dt: float, time: float) -> float | None:
        """Whether a mass at rest stays there; it then does not move at all."""
        sticks = self.rubbing.ask(0.0, load * dt / self.rubbing.mass, dt, time)[1]
        return 0.0 if sticks else None

    def accept(self) -> None:
        """Nothing is kept between increments."""

    def reject(self) -> None:
        """Nothing is kept between increments."""


class CentralDifferences:
    """Velocities in the middle of increments, friction at their ends.

    With kinematic enforcement the velocity of a sticking mass is that of the ground, exactly. The
    times of rest and slip are those of the increments in which they happen: of first order.
    """

    def __init__(self, system: System, rubbing: Rubbing, increment: float) -> None:
        self.system, self.rubbing, self.increment = system, rubbing, increment
        self.x, self.v = (part.copy() for part in system.start)
        self.time, self.steps, self.sticks, self.moves = 0.0, 0, False, bool(self.v[0])
        self.friction = 0.0
        self.events: list[Event] = []

    def run(self, end: float, count: int | None = None) -> list[Event]:
        """Events up to a time, or until there are `count`."""
        while self.time < end - 0.5 * self.increment:
            if count is not None and len(self.events) >= count:
                break
            self.step()
        return self.events

    def hold(self, count: int) -> float:
        """Increments of rest; the largest distance from where they began."""
        start, largest = self.x[0], 0.0
        for _ in range(count):
            self.step()
            largest = max(largest, abs(self.x[0] - start))
        return largest

    def step(self) -> None:
        """One increment."""
        system, h, now = self.system, self.increment, self.time
        # The first increment takes the velocity from its start to its middle.
        width = h if self.steps else 0.5 * h
        before = self.v
        self.v = self.v + width * system.forces(self.x, now) / system.masses
        moved = system.ground(now + h)[0] - system.ground(now)[0]
        if self.rubbing.kinematic:
            self._kinematic(width, now, moved / h)
        else:
            self.v[0] += width * self.friction / system.masses[0]
        if any(abs(now - time) <= 0.5 * h for time in system.breaks):
            self.events.append(Event("break", now, self.x.copy(), 0.5 * (before + self.v)))
        last = self.x
        self.x = self.x + h * self.v
        if self.rubbing.kinematic and self.sticks:
            self.x[0] = last[0] + moved
        elif not self.rubbing.kinematic:
            slip = float(self.x[0] - last[0] - moved)
            self.friction, sticks = self.rubbing.ask(slip, 0.0, h, now + h)
            self._note(sticks, now + h)
        self.steps += 1
        self.time = self.steps * h

    def _kinematic(self, width: float, now: float, ground: float) -> None:
        """Friction that takes the predicted velocity at most to that of the ground."""
        predicted = float(self.v[0] - ground)
        told = 0.0 if self.sticks or not self.moves else predicted * width
        until = now + 0.5 * self.increment
        self.friction, sticks = self.rubbing.ask(told, predicted, width, until)
        self.v[0] = ground if sticks else self.v[0] + width * self.friction / self.system.masses[0]
        self._note(sticks, now)
        self.moves = not sticks

    def _note(self, sticks: bool, time: float) -> None:
        if sticks != self.sticks and self.steps:
            kind = "rest" if sticks else "slip"
            self.events.append(Event(kind, time, self.x.copy(), self.v.copy()))
        self.sticks = sticks
