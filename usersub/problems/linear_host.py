# SPDX-License-Identifier: MIT
"""A quasi-static implicit host: contact points on springs, in as many unknowns as the springs have.

With x the unknowns, the motion of the contact points along their sliding directions is S x, their
pressure p = p0 + P x, and the equations are

    load - K x - B tau = 0,    S dx = 0 at points that stick by multipliers (LM = 1),

tau being the friction stresses along the sliding directions. Newton's method takes the tangents of
the driver, those by the pressure included.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import fixed
from usersub.problems.problem import Stopwatch

if TYPE_CHECKING:
    from usersub.driver.standard import StandardDriver, StandardResponse
    from usersub.routine.routine import Routine

#: Iterations of an increment at most; the change, relative to the largest unknown and to the
#: largest stress, at which it has converged.
MOST_ITERATIONS = 200
_ACCURACY, _ACCURACY_OF_STRESS = 2e-14, 1e-11

#: Oblique to the local directions, for contact points with two of them.
OBLIQUE = np.array([0.8, 0.6])


class NoEquilibriumError(RuntimeError):
    """Newton's method found no solution: nothing holds the load."""


@dataclass(frozen=True)
class Springs:
    """The matrices of the equations; `slip` (S) is n x m, `friction` (B) m x n, `stiffness` m x m,
    `pressure` n and `pressure_change` (P) n x m or None, for n points and m unknowns."""

    slip: np.ndarray
    friction: np.ndarray
    stiffness: np.ndarray
    pressure: np.ndarray
    pressure_change: np.ndarray | None = None


def make_driver(
    routine: Routine,
    props: list[float],
    points: int,
    *,
    directions: int,
    allowable: float,
    lagrange: bool = False,
) -> StandardDriver:
    """A driver with an allowable elastic slip; multipliers instead if `lagrange`."""
    from usersub import Scene, StandardDriver

    scene = Scene(
        points=points, dimension=directions + 1, props=props,
        characteristic_length=allowable / 5e-3,
        states=directions if routine.interface.name == "fric" else 0,
        enforcement="lagrange" if lagrange else "default",
    )  # fmt: skip
    return StandardDriver(routine, scene, reuse=True)


class LinearHost:
    """Contact points of one `driver` on `springs`.

    Args:
        reach: a change of the unknowns above it means that nothing holds.

    Attributes:
        unknowns: x at the end of the last increment.
        stress: stresses along the sliding directions; `across`: the largest one across them.
        dissipated: by point, per area, since the start.
        stuck: where the points stick.
        iterations, increments: so far.
    """

    def __init__(self, driver: StandardDriver, springs: Springs, reach: float) -> None:
        self.driver, self.springs, self.reach = driver, springs, reach
        points, unknowns = springs.slip.shape
        directions = driver.array("tau").shape[0]
        self.lagrange = driver.scene["enforcement"] == "lagrange"
        self.direction = OBLIQUE[:directions] if directions > 1 else np.ones(1)
        self.unknowns = np.zeros(unknowns)
        self.stress, self.dissipated = np.zeros(points), np.zeros(points)
        self.stuck = np.zeros(points, bool)
        self.across, self.iterations, self.increments = 0.0, 0, 0
        self._slip = np.zeros((directions, points), order="F")
        self._multiplier = np.zeros((directions, points), order="F")
        self._pressure = np.array(springs.pressure)
        known = driver.layout.ports
        extra = {"coord": np.zeros((directions + 1, points), order="F")} if "coord" in known else {}
        driver.bind(slip_increment=self._slip, pressure=self._pressure,
                    multiplier=self._multiplier, **extra)  # fmt: skip
        driver.begin_increment(1.0)  # closes the contact: no friction yet
        fixed.iterate(driver)
        driver.commit()
        self.watch = Stopwatch()

    def solve(
        self, load: np.ndarray, dt: float = 1.0, stiffness: np.ndarray | None = None
    ) -> np.ndarray:
        """One increment to `load`; the unknowns at its end.

        Raises:
            NoEquilibriumError: nothing holds the load; the increment is cut back.
        """
        springs, x = self.springs, self.unknowns.copy()
        matrix = springs.stiffness if stiffness is None else stiffness
        self.driver.begin_increment(dt)
        self._multiplier[...] = self.direction[:, None] * self.stress
        for iteration in range(MOST_ITERATIONS):
            answer = self._ask(x, sticking=iteration == 0)
            stress = self.direction @ answer.tau if iteration else self.stress
            residual = load - matrix @ x - springs.friction @ stress
            found = self._change(matrix, residual, answer)
            change = found[: x.size]
            if not np.abs(change).max() <= self.reach:
                break
            # Conditions are not compared: points at the cone that do not move may flicker.
            multipliers = np.abs(found[x.size :]).max(initial=0.0)
            held = multipliers <= _ACCURACY_OF_STRESS * np.abs(stress).max()
            if held and np.abs(change).max() <= _ACCURACY * np.abs(x).max():
                self._accept(x, stress, answer)
                return x
            x = x + change
        self.driver.cut_back()
        raise NoEquilibriumError(f"no equilibrium after {self.iterations} iterations")

    def _ask(self, x: np.ndarray, sticking: bool) -> StandardResponse:
        """Stress and tangents; those of points that stick, from which each increment begins, since
        points at the cone would slip by rounding alone."""
        springs = self.springs
        self._slip[...] = self.direction[:, None] * (springs.slip @ (x - self.unknowns))
        if sticking and not self.lagrange:
            name = "elastic_slip" if "elastic_slip" in self.driver.layout.ports else "state"
            self._slip[...] -= self.driver.state[name][: self.direction.size]
        if springs.pressure_change is not None:
            self._pressure[...] = springs.pressure + springs.pressure_change @ x
        self.iterations += 1
        with self.watch:
            return fixed.iterate(self.driver)

    def _change(
        self, matrix: np.ndarray, residual: np.ndarray, answer: StandardResponse
    ) -> np.ndarray:
        """Newton's change of the unknowns, then of the multipliers, which is taken on; NaN if there
        is none."""
        springs, e = self.springs, self.direction
        by_slip = np.einsum("a,abk,b->k", e, answer.ddtddg, e)
        tangent = matrix + springs.friction @ (by_slip[:, None] * springs.slip)
        if springs.pressure_change is not None:
            by_pressure = e @ answer.ddtddp
            tangent = tangent + springs.friction @ (by_pressure[:, None] * springs.pressure_change)
        stuck = np.flatnonzero(answer.lm == 1)
        m, s = tangent.shape[0], stuck.size
        whole = np.zeros((m + s, m + s))
        whole[:m, :m] = tangent
        whole[:m, m:] = springs.friction[:, stuck]
        whole[m:, :m] = springs.slip[stuck]
        right = np.concatenate([residual, -(e @ self._slip[:, stuck])])
        try:
            found = np.linalg.solve(whole, right)
        except np.linalg.LinAlgError:
            return np.full(m + s, np.nan)
        self._multiplier[...] = answer.tau
        self._multiplier[:, stuck] += e[:, None] * found[m:]
        return found

    def _accept(self, x: np.ndarray, stress: np.ndarray, answer: StandardResponse) -> None:
        self.driver.commit()
        self.unknowns, self.stress = x, stress
        self.dissipated = self.dissipated + answer.sfd
        self.stuck = np.abs(self.direction @ answer.dslip) == 0.0
        if self.direction.size > 1:
            across = np.abs(np.array([-OBLIQUE[1], OBLIQUE[0]]) @ answer.tau).max()
            self.across = max(self.across, float(across))
        self.increments += 1
