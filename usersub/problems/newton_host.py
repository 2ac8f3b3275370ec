# SPDX-License-Identifier: MIT
"""An implicit host with real Lagrange multipliers: elastic points on springs, pressed and dragged.

Each contact point has a motion along the friction directions and one along the normal. Springs with
coupled directions hold it to a base that moves, further springs hold it to its neighbours in a row,
and its pressure is that of a linear contact stiffness, so that every friction stress depends on the
motion of all points and on their pressures. The unknowns of an increment are the motions and, at
points that stick by multipliers (LM = 1), their constraint stresses:

    springs(u) - stress - pressure = 0,     slip increment = 0 where LM = 1.

Newton's method takes the tangents of the driver as they are, or their symmetric part.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from usersub.driver.standard import StandardDriver, StandardResponse
from usersub.problems import fixed

#: Iterations of an increment at most, and the residual at which it has converged, as a fraction of
#: the forces.
MOST_ITERATIONS = 60
ACCURACY = 1e-13

#: Distances from the solution at which the order of convergence is found, over the smallest slip.
PROBES = (1e-3, 1e-4)

#: Stiffness of contact, against springs of about one.
CONTACT = 20.0


@dataclass
class Increment:
    """What Newton's method did: residuals before each correction, and LM of all points with them.

    `residuals` are fractions of the forces; the last one is of the solution. `slipping` counts the
    points that slip in the end. `order` is that of one correction from near the solution: the
    error after it falls with this power of the error before. None where it is rounding at once.
    `symmetric_order` is the same with the symmetric part of the tangent.
    """

    residuals: list[float] = field(default_factory=list)
    conditions: list[np.ndarray] = field(default_factory=list)
    slipping: int = 0
    symmetry: str = ""
    order: float | None = None
    symmetric_order: float | None = None


class NoEquilibriumError(RuntimeError):
    """Newton's method did not converge."""


def stiffness(points: int, directions: int) -> tuple[np.ndarray, np.ndarray]:
    """Springs between base and points, and of all; shape (n, n), n = points (directions + 1)."""
    size = directions + 1
    base = np.zeros((points * size, points * size))
    for i in range(points):
        block = np.diag([1.0, 1.3, 2.0][:directions] + [1.7])
        for a in range(size):
            for b in range(a):
                block[a, b] = block[b, a] = 0.06 * (1 + a) - 0.02 * b
        own = slice(i * size, (i + 1) * size)
        base[own, own] = block * (1.0 + 0.7 * np.sin(1.0 + 2.3 * i))
    whole = base.copy()
    for i in range(points - 1):
        for a in range(size):
            j, k = i * size + a, (i + 1) * size + a
            for m, n, sign in ((j, j, 1), (k, k, 1), (j, k, -1), (k, j, -1)):
                whole[m, n] += sign * (2.0 - 0.5 * a)
    return base, whole


class NewtonHost:
    """Contact points of one `driver` between springs.

    Args:
        symmetric: drop from the tangent what is not symmetric.
    """

    def __init__(self, driver: StandardDriver, *, symmetric: bool = False) -> None:
        scene = driver.scene
        self.driver, self.symmetric = driver, symmetric
        self.points = scene["points"]
        self.directions = scene["friction_directions"] or scene["dimension"] - 1
        size = self.directions + 1
        self.base, self.whole = stiffness(self.points, self.directions)
        own = np.arange(self.points)[:, None] * size
        self.sliding = own + np.arange(self.directions)  # unknowns, shape (points, directions)
        self.normal = (own + self.directions)[:, 0]
        self.motion = np.zeros(self.points * size)  # committed
        shape = (self.directions, self.points)
        self.slip, self.multiplier = np.zeros(shape, order="F"), np.zeros(shape, order="F")
        self.pressure = np.zeros(self.points)
        driver.bind(slip_increment=self.slip, multiplier=self.multiplier, pressure=self.pressure)

    def increment(
        self, place: np.ndarray, time_increment: float, *, probe: bool = False, **named: Any
    ) -> Increment:
        """Moves the base to `place` (directions and normal), solves, commits.

        Args:
            probe: find the order of convergence at the solution, too.
            named: of `begin_increment`.

        Raises:
            NoEquilibriumError: it does not converge; the increment is cut back.
        """
        found = Increment()
        force = self.base @ np.tile(place, self.points)
        scale = np.linalg.norm(force)
        motion = self._guess(force)
        self.driver.begin_increment(time_increment, **named)
        before: np.ndarray | None = None
        for _ in range(MOST_ITERATIONS):
            answer = self._ask(motion)
            residual, stuck = self._residual(motion, force, answer)
            found.residuals.append(float(np.linalg.norm(residual) / scale))
            found.conditions.append(answer.lm.copy())
            same = before is not None and np.array_equal(before, answer.lm)
            if same and found.residuals[-1] <= ACCURACY:
                found.slipping = int(np.count_nonzero(answer.dslip.any(axis=0)))
                found.symmetry = self.driver.symmetry().sentence
                if probe:
                    found.order = self._probe(motion, force, symmetric=False)
                    found.symmetric_order = self._probe(motion, force, symmetric=True)
                self.driver.commit()
                self.motion = motion
                return found
            before = answer.lm.copy()
            self._correct(motion, residual, stuck, answer)
        self.driver.cut_back()
        raise NoEquilibriumError(f"residuals {found.residuals[-4:]}")

    def _probe(self, motion: np.ndarray, force: np.ndarray, *, symmetric: bool) -> float | None:
        """Order of one correction from near the solution `motion`, which is asked again after."""
        kept, self.symmetric = self.symmetric, symmetric
        multiplier, slip = self.multiplier.copy(), np.linalg.norm(self.slip, axis=0)
        size = float(slip[slip > 1e-9 * slip.max()].min(initial=1.0))  # others stick
        away = np.random.default_rng(5).uniform(-1.0, 1.0, motion.size)
        errors = []
        for share in PROBES:
            near = motion + share * size * away
            answer = self._ask(near)
            residual, stuck = self._residual(near, force, answer)
            self._correct(near, residual, stuck, answer)
            errors.append(float(np.linalg.norm(near - motion)) / size)
            self.multiplier[...] = multiplier
        self.symmetric = kept
        self._ask(motion)
        if errors[0] < 1e-9:
            return None
        return math.log(errors[0] / errors[1]) / math.log(PROBES[0] / PROBES[1])

    def _guess(self, force: np.ndarray) -> np.ndarray:
        """Where the points are if none slides in the increment."""
        motion, n = self.motion.copy(), self.normal
        normal = self.whole[np.ix_(n, n)] + CONTACT * np.eye(self.points)
        away = force[n] - self.whole[n] @ motion - CONTACT * motion[n]
        motion[n] += np.linalg.solve(normal, away)
        return motion

    def _ask(self, motion: np.ndarray) -> StandardResponse:
        self.slip[...] = (motion - self.motion)[self.sliding].T
        self.pressure[...] = CONTACT * motion[self.normal]
        return fixed.iterate(self.driver)

    def _residual(
        self, motion: np.ndarray, force: np.ndarray, answer: StandardResponse
    ) -> tuple[np.ndarray, np.ndarray]:
        """Forces that are not in equilibrium, then slip that is not allowed; and where that is."""
        stuck = np.flatnonzero(answer.lm == 1)
        residual = force - self.whole @ motion
        residual[self.sliding] -= answer.tau.T
        residual[self.normal] -= self.pressure
        return np.concatenate([residual, -self.slip[:, stuck].T.ravel()]), stuck

    def _correct(
        self, motion: np.ndarray, residual: np.ndarray, stuck: np.ndarray, answer: StandardResponse
    ) -> None:
        """One correction of motion and multipliers; those of points that slip follow them."""
        n, extra = motion.size, self.sliding[stuck].ravel()
        tangent = np.zeros((n + extra.size, n + extra.size))
        tangent[:n, :n] = self.whole
        tangent[self.normal, self.normal] += CONTACT
        for p in range(self.points):
            rows = self.sliding[p]
            tangent[np.ix_(rows, rows)] += answer.ddtddg[:, :, p]  # type: ignore[index]
            tangent[rows, self.normal[p]] += CONTACT * answer.ddtddp[:, p]  # type: ignore[index]
        if self.symmetric:
            tangent = 0.5 * (tangent + tangent.T)
        constraint = np.arange(n, n + extra.size)
        tangent[extra, constraint] = tangent[constraint, extra] = 1.0
        correction = np.linalg.solve(tangent, residual)
        motion += correction[:n]
        self.multiplier[...] = answer.tau
        self.multiplier[:, stuck] += correction[n:].reshape(stuck.size, self.directions).T
