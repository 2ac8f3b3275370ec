# SPDX-License-Identifier: MIT
"""The rigid block in an implicit host, through FRIC or FRIC_COEF.

Implicit midpoint rule: the unknown of an increment is the motion dx, the velocities follow from
dx = dt (v0 + v1)/2, and Newton solves

    m (v1 - v0)/dt + sum of A tau(dx) = 0

with the tangents of the driver. The slip rate of the increment, dx/dt, is the velocity at its
middle: the rule is symmetric, of second order, and its error a series in even powers of dt.

Two increments come before: one that closes the contact, and one that brings the elastic slip to its
limit, so that the block starts in full friction like the rigid-plastic one of the exact answer.
The time increment is such that the block stands still after a whole number of increments; it is
found by Newton, each trial from the saved state. "Romberg" extrapolates from a sequence of such
runs with doubled numbers of increments.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import fixed
from usersub.problems.block import NOT_STOPPED, Block, Stop
from usersub.problems.problem import Stopwatch
from usersub.problems.rigid import contact_areas

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Runs of the Romberg sequence, each with twice the increments of the one before.
_ROMBERG_LEVELS = 4

_NEWTON_LIMIT = 20
_NEWTON_ACCURACY = 1e-13

#: The block slides obliquely to the local directions.
_DIRECTION = np.array([0.8, 0.6])


class ImplicitBlock:
    """The block, its contact driver and its Newton iterations."""

    def __init__(self, block: Block, routine: Routine, props: list[float], points: int) -> None:
        from usersub import Scene, StandardDriver

        self.block, self.points = block, points
        self.area = contact_areas(block, points)
        self.allowable = 0.005 * block.height
        scene = Scene(
            points=points, dimension=3, props=props, characteristic_length=block.height,
            states=2 if routine.interface.name == "fric" else 0,
        )  # fmt: skip
        self.driver = StandardDriver(routine, scene, reuse=True)
        self.slip = np.zeros((2, points), order="F")
        self.pressure = np.full(points, block.pressure)
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        self.driver.bind(slip_increment=self.slip, pressure=self.pressure, **extra)
        self.iterations = self.increments = 0
        self._load()
        self.start = self.driver.state.save()
        self.watch = Stopwatch()

    def _load(self) -> None:
        """Closes the contact, then slips elastically to the limit."""
        for share in (0.0, 1.0):
            self.driver.begin_increment(1.0)
            self.slip[...] = share * self.allowable * _DIRECTION[:, None]
            fixed.iterate(self.driver)
            self.driver.commit()

    def increment(self, v: np.ndarray, dt: float) -> tuple[np.ndarray, np.ndarray]:
        """One increment from velocity `v`: the velocity at its end and the motion."""
        m, area = self.block.mass, self.area
        self.driver.begin_increment(dt)
        dx = v * dt
        for _ in range(_NEWTON_LIMIT):
            self.slip[...] = dx[:, None]
            with self.watch:
                response = fixed.iterate(self.driver)
            self.iterations += 1
            inertia = m * (2.0 * dx / dt - 2.0 * v) / dt
            residual = inertia + response.tau @ area
            tangent = 2.0 * m / dt**2 * np.eye(2) + response.ddtddg @ area
            change = np.linalg.solve(tangent, residual)
            dx = dx - change
            if np.abs(change).max() <= _NEWTON_ACCURACY * np.abs(dx).max():
                break
        self.driver.commit()
        self.increments += 1
        return 2.0 * dx / dt - v, dx

    def slide(
        self, time: float, count: int, rows: list | None = None
    ) -> tuple[float, float, float]:
        """`count` increments up to `time`: velocity, distance, friction force at the end."""
        self.driver.state.load(self.start)
        v, x, dt = self.block.velocity * _DIRECTION, np.zeros(2), time / count
        for i in range(count):
            v, dx = self.increment(v, dt)
            x = x + dx
            force = float(_DIRECTION @ (self.driver.array("tau") @ self.area))
            if rows is not None:
                rows.append(((i + 1) * dt, float(_DIRECTION @ x), float(_DIRECTION @ v), force))
        return float(_DIRECTION @ v), float(_DIRECTION @ x), force

    def stop(self, guess: float, count: int, rows: list | None = None) -> Stop:
        """Time and distance at rest after `count` equal increments; NaN if nothing brakes."""
        time = guess
        for _ in range(_NEWTON_LIMIT):
            v, x, force = self.slide(time, count)
            if not force > 0.0:
                return NOT_STOPPED
            change = v * self.block.mass / force
            time += change
            if abs(change) <= 1e-14 * time:
                break
        if rows is not None:
            self.slide(time, count, rows)
        return Stop(time, x)

    def extrapolated_stop(self, guess: float, count: int, rows: list | None = None) -> Stop:
        """Extrapolates from runs of up to `count` increments."""
        stops: list[Stop] = []
        for level in reversed(range(_ROMBERG_LEVELS)):
            last = level == 0
            stop = self.stop(guess, max(1, count >> level), rows if last else None)
            if stop is NOT_STOPPED:
                return NOT_STOPPED
            stops.append(stop)
            guess = stop.time
        return Stop(_romberg([s.time for s in stops]), _romberg([s.distance for s in stops]))


def _romberg(values: list[float]) -> float:
    """Extrapolates results of 1, 2, 4, ... times as many increments; only even powers of dt."""
    for level in range(1, len(values)):
        factor = 4.0**level
        values = [
            fine + (fine - coarse) / (factor - 1.0)
            for coarse, fine in zip(values, values[1:], strict=False)
        ]
    return values[0]
