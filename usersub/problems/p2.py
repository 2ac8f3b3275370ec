# SPDX-License-Identifier: MIT
"""P2: the block of P1 with a coefficient that decays exponentially with the slip rate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.block import Block, Stop, exact_stop
from usersub.problems.block_runs import METHODS, OPTIONS, BlockRun
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

BLOCK = Block()
STATIC, KINETIC, DECAY = 0.15, 0.05, 0.01


def exact() -> Stop:
    """Time in closed form, distance by quadrature."""
    change = STATIC - KINETIC
    scale = BLOCK.pressure * BLOCK.area / BLOCK.mass
    growth = KINETIC * math.exp(DECAY * BLOCK.velocity) + change
    time = math.log(growth / STATIC) / (scale * KINETIC * DECAY)
    distance = exact_stop(BLOCK, lambda v: KINETIC + change * np.exp(-DECAY * v)).distance
    return Stop(time, distance)


#: Relative errors of time and distance of the rigid block in 128 increments, by method.
_TOLERANCES = {"rigid rk4": 1e-9, "implicit Romberg": 1e-9, "implicit": 1e-4, "rigid": 1e-4}


def run(routine: Routine, law: str, precision: str, method: str, **options: object) -> Outcome:
    """One run.

    To 1e-9: "rigid rk4" (fourth order, last step over the velocity) and "implicit Romberg"
    (midpoint rule, extrapolated). "rigid" (central differences) and "implicit" are of second order.
    """
    made = BlockRun(
        "P2", BLOCK, exact(), [STATIC, KINETIC, DECAY], _TOLERANCES.get(method, math.nan),
        routine, law, precision, method, **options,
    )  # fmt: skip
    return made.outcome()


PROBLEM = Problem(
    name="P2",
    title="Block stopped by friction that decays exponentially with the slip rate",
    statement="The block of P1; the coefficient falls from 0.15 at rest to 0.05 with the decay "
    "coefficient 0.01 s/in. When and where does it stop?",
    laws=("exponential_decay",),
    methods=METHODS,
    runner=run,
    options=OPTIONS,
)
