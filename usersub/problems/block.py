# SPDX-License-Identifier: MIT
"""The block of problems P1 and P2: a block slides on a rigid plane until friction has stopped it.

It is the verification problem of the commercial manual: 5 x 1 x 1 in, pressed down by 2000 psi,
initial velocity 200 in/s along its length. Units: in, s, lbf.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


@dataclass(frozen=True)
class Block:
    """Data of the block.

    Attributes:
        length, width, height: in.
        density: lbf s2/in4.
        young: psi. poisson: -, not published and without influence on the exact answer.
        pressure: on the top face, psi.
        velocity: at the start, in/s.
    """

    length: float = 5.0
    width: float = 1.0
    height: float = 1.0
    density: float = 7.3e-4
    young: float = 30e6
    poisson: float = 0.3
    pressure: float = 2000.0
    velocity: float = 200.0

    @property
    def area(self) -> float:
        """Area of the contact face, in2."""
        return self.length * self.width

    @property
    def mass(self) -> float:
        """Mass, lbf s2/in."""
        return self.density * self.area * self.height


class Stop(NamedTuple):
    """Where and when the block stands still: time in s, distance in in."""

    time: float
    distance: float

    def error(self, exact: Stop) -> tuple[float, float]:
        """Relative errors of time and distance."""
        return abs(self.time / exact.time - 1.0), abs(self.distance / exact.distance - 1.0)


#: The answer of a run that has not stopped the block.
NOT_STOPPED = Stop(np.nan, np.nan)

#: Gauss points of the exact answer; the integrand is analytic, and 40 points reach rounding.
_GAUSS_POINTS = 40


def exact_stop(block: Block, mu: Callable[[np.ndarray], np.ndarray]) -> Stop:
    """Exact answer for a coefficient that depends on the slip rate alone.

    With the deceleration mu(v) p A/m, time and distance are the integrals of 1/deceleration and
    v/deceleration over the velocity; by Gauss-Legendre quadrature.
    """
    nodes, weights = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    v = 0.5 * block.velocity * (nodes + 1.0)
    inverse = block.mass / (mu(v) * block.pressure * block.area)
    w = 0.5 * block.velocity * weights
    return Stop(float(w @ inverse), float(w @ (v * inverse)))
