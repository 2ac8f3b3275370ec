# SPDX-License-Identifier: MIT
"""Masses on springs that slide steadily: time integration with friction that follows the pressure.

Each contact point belongs to its own mass of n degrees of freedom,

    u'' + 2 d u' + S u + g tau(p) = f,    p = p0 + c.u,    slip rate V + e.u' > 0,

everything by mass. In implicit hosts by the implicit midpoint rule, whose Newton's method takes the
driver's tangents by slip and pressure; in explicit ones by central differences.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from usersub.problems.sliding_points import Answer, ExplicitPoints, StandardPoints

#: Corrections of an increment at most, and the change at which it has converged.
_NEWTON_LIMIT, _NEWTON_ACCURACY = 12, 1e-13


@dataclass
class Oscillators:
    """The system; `stiffness` has the shape (n, n, points), vectors (n, points).

    Attributes:
        stiffness: S, without friction.
        friction: g, of the friction stress.
        pressure: p0, shape (points,).
        pressure_change: c.
        load: f.
        slip_rate: V, of all points.
        slip_change: e.
        damping: d.
    """

    stiffness: np.ndarray
    friction: np.ndarray
    pressure: np.ndarray
    pressure_change: np.ndarray
    load: np.ndarray
    slip_rate: float
    slip_change: np.ndarray
    damping: float = 0.0

    def pressure_at(self, u: np.ndarray) -> np.ndarray:
        """p at a place."""
        return self.pressure + (self.pressure_change * u).sum(0)

    def tangent(self, answer: Answer) -> np.ndarray:
        """S with the driver's tangents: what changes with u where the slip does as well."""
        by = answer.by_pressure * self.pressure_change + answer.by_slip * self.slip_change
        return self.stiffness + np.einsum("ik,jk->ijk", self.friction, by)

    def forces(self, u: np.ndarray, stress: np.ndarray) -> np.ndarray:
        """f - S u - g tau."""
        return self.load - np.einsum("ijk,jk->ik", self.stiffness, u) - self.friction * stress

    def run(
        self,
        points: StandardPoints | ExplicitPoints,
        place: np.ndarray,
        velocity: np.ndarray,
        time: float,
        steps: int,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Place and velocity after `time`."""
        # A routine that gives nothing sensible ends in overflow, which is no warning's matter.
        with np.errstate(all="ignore"):
            if isinstance(points, StandardPoints):
                return self._midpoint(points, place, velocity, time / steps, steps)
            return self._central(points, place, velocity, time / steps, steps)

    def _midpoint(
        self, points: StandardPoints, u: np.ndarray, v: np.ndarray, h: float, steps: int
    ) -> tuple[np.ndarray, np.ndarray]:
        inertia = (4.0 / h**2 + 4.0 * self.damping / h) * np.eye(len(u))[:, :, None]
        move = h * v  # motion in the increment
        for _ in range(steps):
            points.begin(h)
            for _ in range(_NEWTON_LIMIT):
                middle = u + 0.5 * move
                slip = self.slip_rate * h + (self.slip_change * move).sum(0)
                answer = points.ask(slip, self.pressure_at(middle))
                acceleration = 2.0 * (move / h - v) / h
                residual = self.forces(middle, answer.stress)
                residual -= acceleration + 2.0 * self.damping * move / h
                # By half the motion, of which the slip is twice.
                tangent = inertia + self.tangent(answer._replace(by_slip=2.0 * answer.by_slip))
                change = np.linalg.solve(np.moveaxis(tangent, -1, 0), residual.T[:, :, None])
                move = move + 2.0 * change[:, :, 0].T
                if not np.abs(change).max() > _NEWTON_ACCURACY * np.abs(move).max():
                    break
            points.end(commit=True)
            u, v = u + move, 2.0 * move / h - v
            move = h * v
        return u, v

    def _central(
        self, points: ExplicitPoints, u: np.ndarray, v: np.ndarray, h: float, steps: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """Velocities in the middle of increments; the damping is that of their mean."""

        def pushed() -> np.ndarray:
            points.begin(h)
            slip = h * (self.slip_rate + (self.slip_change * v).sum(0))
            stress = points.stress(slip, self.pressure_at(u))
            points.end(commit=True)
            return self.forces(u, stress)

        share = self.damping * h
        v = (1.0 - share) * v + 0.5 * h * pushed()
        for _ in range(steps - 1):
            u = u + h * v
            v = ((1.0 - share) * v + h * pushed()) / (1.0 + share)
        u = u + h * v
        return u, (v + 0.5 * h * pushed()) / (1.0 + share)
