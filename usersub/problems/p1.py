# SPDX-License-Identifier: MIT
"""P1: a block stopped by Coulomb friction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from usersub.problems.block import Block, Stop
from usersub.problems.block_runs import METHODS, OPTIONS, BlockRun
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

BLOCK = Block()
MU = 0.15


def exact() -> Stop:
    """Constant deceleration mu p A/m."""
    deceleration = MU * BLOCK.pressure * BLOCK.area / BLOCK.mass
    time = BLOCK.velocity / deceleration
    return Stop(time, 0.5 * BLOCK.velocity * time)


def run(routine: Routine, law: str, precision: str, method: str, **options: object) -> Outcome:
    """One run. The rigid block is exact in every method, up to rounding."""
    made = BlockRun("P1", BLOCK, exact(), [MU], 1e-9, routine, law, precision, method, **options)
    return made.outcome()


PROBLEM = Problem(
    name="P1",
    title="Block stopped by Coulomb friction",
    statement="A block of 5 x 1 x 1 in, density 7.3e-4 lbf s2/in4, is pressed on a rigid plane by "
    "2000 psi and starts with 200 in/s along its length; the coefficient is 0.15. When and where "
    "does it stop? Verification problem of the commercial manual, whose own finite-element answer "
    "is 4.878e-4 s and 4.866e-2 in.",
    laws=("coulomb",),
    methods=METHODS,
    runner=run,
    options=OPTIONS,
)
