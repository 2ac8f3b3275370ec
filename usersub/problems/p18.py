# SPDX-License-Identifier: MIT
"""P18: a point that weakens with its slip: peak, residual, and the energy of the drop."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.path_host import Path, outcome, worst
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Static and dynamic coefficient, slip of the drop (m), pressure (Pa), slip rate (m/s).
STATIC, DYNAMIC, DISTANCE, PRESSURE, RATE = 0.677, 0.525, 0.4, 120e6, 1.0

#: Gauss points of the energy, over slips up to so many times the distance.
_NODES, _REACH = 24, {"slip_weakening": 1.0, "slip_weakening_exponential": 40.0}

_ALLOWABLE = 1e-3
_TOLERANCES = {"double": 1e-12, "single": 2e-5}


def energy(law: str) -> float:
    """Energy of the drop, per area."""
    share = 0.5 if law == "slip_weakening" else -math.expm1(-_REACH[law])
    return share * (STATIC - DYNAMIC) * PRESSURE * DISTANCE


def _stops(law: str) -> tuple[np.ndarray, np.ndarray]:
    """Slips and weights of the quadrature: over the slip, or over the share that is left."""
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    if law == "slip_weakening":
        reach = DISTANCE * _REACH[law]
        return 0.5 * reach * (nodes + 1.0), 0.5 * reach * weights
    # ds = DISTANCE du/(1 - u) with the share u that is gone, which ends at 1 - exp(-reach)
    gone = 0.5 * -math.expm1(-_REACH[law]) * (nodes + 1.0)
    return (
        -DISTANCE * np.log1p(-gone),
        0.5 * -math.expm1(-_REACH[law]) * weights * DISTANCE / (1.0 - gone),
    )


def run(routine: Routine, law: str, precision: str, method: str, *, points: int = 8) -> Outcome:
    """One run against the closed forms."""
    path = Path(routine, law, [STATIC, DYNAMIC, DISTANCE], points, precision, _ALLOWABLE)
    # A slip too small to weaken anything.
    peak = path.move(1e-14 * DISTANCE, 1e-9, PRESSURE)
    slips, weights = _stops(law)
    before, work = 0.0, np.zeros(points)
    for slip, weight in zip(slips, weights, strict=True):
        traction = path.move(slip - before, (slip - before) / RATE, PRESSURE)
        before = slip
        work += weight * (traction - DYNAMIC * PRESSURE)
    last = path.move(100.0 * DISTANCE, 100.0 * DISTANCE / RATE, PRESSURE)
    errors = {
        "peak": worst(peak, STATIC * PRESSURE),
        "residual": worst(last, DYNAMIC * PRESSURE),
        "energy": worst(work, energy(law)),
    }
    return outcome(
        "P18", routine, law, precision, method, path, errors, _TOLERANCES[precision],
        100.0 * DISTANCE / RATE, "peak, residual, energy",
    )  # fmt: skip


PROBLEM = Problem(
    name="P18",
    title="Point that weakens with its slip",
    statement="The coefficient falls from 0.677 to 0.525 over 0.40 m under 120 MPa: peak "
    "81.24 MPa, residual 63.0 MPa, energy of the drop 3.648 MJ/m2; twice that where it falls "
    "exponentially. Exact for any increments.",
    laws=("slip_weakening", "slip_weakening_exponential"),
    methods=dict.fromkeys(("fric", "fric_coef", "vfric", "vfriction"), ("rigid load",)),
    runner=run,
    options={"points": "contact points"},
)
