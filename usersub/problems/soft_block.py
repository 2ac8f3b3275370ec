# SPDX-License-Identifier: MIT
"""The rigid block of P1 on an elastic contact: hosts of P23.

Explicit: central differences, friction at the end of each increment from the slip so far. Implicit:
trapezoidal rule, solved by Newton's method with the tangents of the driver. Both are of second
order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from usersub.problems import fixed, rigid
from usersub.problems.block import Block
from usersub.problems.explicit_contact import ExplicitContact
from usersub.problems.problem import Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: The slip is oblique to the local directions of the implicit host.
_ALONG = np.array([[0.8], [0.6]])

_NEWTON_LIMIT = 20
_NEWTON_ACCURACY = 1e-14


class Turn(NamedTuple):
    """Where the block turns back."""

    time: float
    place: float


class Host(Protocol):
    """A block on its contact."""

    watch: Stopwatch

    def trace(self, increment: float, count: int) -> np.ndarray:
        """Places at the ends of increments, the start included."""


class ExplicitBlock:
    """Central differences."""

    def __init__(
        self,
        block: Block,
        routine: Routine,
        props: list[float],
        points: int,
        precision: str,
        **settings: object,
    ) -> None:
        dimension = 2 if routine.interface.name == "vfric" else 3
        self.block = block
        self.along = np.array([1.0, 0.0] if dimension == 2 else [0.8, 0.0, 0.6])[:, None]
        area = rigid.contact_areas(block, points)
        self.contact = ExplicitContact(
            routine, props, rigid.contact_coordinates(block, points, dimension), area,
            precision=precision, **settings,
        )  # fmt: skip
        self.normal_force = block.pressure * area
        # A contact that is elastic needs no bound against moving backwards.
        bound = "stick_force" in self.contact.arrays
        self.stick_force = np.full(points, 1e18) if bound else None
        self.watch = self.contact.watch

    def trace(self, increment: float, count: int) -> np.ndarray:
        """Places at the ends of increments, the start included."""
        places, v, friction, width = [0.0], self.block.velocity, 0.0, 0.5 * increment
        for i in range(count):
            v += width * friction / self.block.mass
            width = increment
            forces = self.contact.force(
                self.along * (v * increment), self.normal_force, self.stick_force, increment,
                (i + 1) * increment,
            )  # fmt: skip
            friction = float((self.along * forces).sum())
            places.append(places[-1] + v * increment)
        return np.array(places)


class ImplicitBlock:
    """Trapezoidal rule."""

    def __init__(
        self, block: Block, routine: Routine, props: list[float], points: int, **settings: object
    ) -> None:
        from usersub import Scene, StandardDriver

        self.block, self.area = block, rigid.contact_areas(block, points)
        scene = Scene(points=points, dimension=3, props=props, **settings)
        self.driver = StandardDriver(routine, scene, reuse=True)
        self.slip = np.zeros((2, points), order="F")
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        pressure = np.full(points, block.pressure)
        self.driver.bind(slip_increment=self.slip, pressure=pressure, **extra)
        self.driver.begin_increment(1.0)  # closes the contact: no friction yet
        fixed.iterate(self.driver)
        self.driver.commit()
        self.watch = Stopwatch()

    def trace(self, increment: float, count: int) -> np.ndarray:
        """Places at the ends of increments, the start included."""
        places, v, friction = [0.0], self.block.velocity, 0.0
        for _ in range(count):
            motion, friction = self._increment(v, friction, increment)
            places.append(places[-1] + motion)
            v = 2.0 * motion / increment - v
        return np.array(places)

    def _increment(self, v: float, before: float, h: float) -> tuple[float, float]:
        """Motion of an increment, and the friction at its end."""
        m, motion = self.block.mass, v * h
        self.driver.begin_increment(h)
        for _ in range(_NEWTON_LIMIT):
            self.slip[...] = _ALONG * motion
            with self.watch:
                response = fixed.iterate(self.driver)
            friction = float((_ALONG * (response.tau * self.area)).sum())
            along = np.einsum("ai,abn,bi,n->", _ALONG, response.ddtddg, _ALONG, self.area)
            residual = 2.0 * m * (motion / h - v) / h + 0.5 * (before + friction)
            change = residual / (2.0 * m / h**2 + 0.5 * along)
            motion -= change
            if abs(change) <= _NEWTON_ACCURACY * self.block.velocity * h:
                break
        self.driver.commit()
        return motion, friction


def turns(places: np.ndarray, increment: float) -> list[Turn]:
    """Turning points of a trace, by parabolas through three places."""
    found = []
    before, here, after = places[:-2], places[1:-1], places[2:]
    for i in np.flatnonzero((here - before) * (after - here) <= 0.0):
        rise, bend = 0.5 * (after[i] - before[i]), after[i] - 2.0 * here[i] + before[i]
        share = -rise / bend if bend else 0.0
        found.append(Turn((i + 1 + share) * increment, here[i] + 0.5 * share * rise))
    return found
