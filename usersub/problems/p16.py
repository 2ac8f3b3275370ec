# SPDX-License-Identifier: MIT
"""P16: slide, hold, slide: contacts at rest grow stronger with the logarithm of the time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from usersub.problems.path_host import PRESSURE, Path, outcome, worst
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficient at the rate V0, direct effect, effect of the state, V0, slip that renews contacts.
MU, A, B, RATE, DISTANCE = 0.6, 0.005, 0.01, 1e-3, 1.0

#: Times at rest, and how many increments each takes.
HOLDS = ((10.0, 1), (1e3, 7), (1e5, 3), (1e7, 1))

#: Slip after the hold where the coefficient is taken; then slip until all is steady again.
_FIRST, _STEADY, _ALLOWABLE = 1e-3, 60.0, 1e-3

_TOLERANCES = {"double": 1e-11, "single": 2e-3}


def growth(hold: float) -> float:
    """How much the coefficient has grown at the first slip after a hold."""
    return B * math.log1p(hold * RATE / DISTANCE)


def run(routine: Routine, law: str, precision: str, method: str, *, points: int = 8) -> Outcome:
    """One run against the closed form; errors are those of the growth."""
    props = [MU, A, B, RATE, DISTANCE, DISTANCE / RATE, 1e-12]
    path = Path(routine, law, props, points, precision, _ALLOWABLE)
    errors = {}
    for hold, increments in HOLDS:
        steady = path.move(_STEADY, _STEADY / RATE) / PRESSURE
        for _ in range(increments):
            path.move(0.0, hold / increments)
        peak = path.move(_FIRST, _FIRST / RATE) / PRESSURE
        # On the way of the first slip the state has decayed a little: theta at its end.
        rest = DISTANCE / RATE
        theta = rest + hold * math.exp(-_FIRST / DISTANCE)
        exact = B * math.log(theta / rest)
        errors[f"after {hold:g}"] = worst(peak - steady, exact)
    return outcome(
        "P16", routine, law, precision, method, path, errors, _TOLERANCES[precision],
        HOLDS[-1][0], "growth of the coefficient",
    )  # fmt: skip


PROBLEM = Problem(
    name="P16",
    title="Slide, hold, slide",
    statement="Contact points slide steadily at 1e-3, rest for 10 to 1e7, and slide again. At "
    "rest the state grows by the time, the coefficient by b ln(1 + time/theta). Exact for any "
    "increments.",
    laws=("rate_state_ageing",),
    methods=dict.fromkeys(("fric", "fric_coef", "vfric", "vfriction"), ("rigid load",)),
    runner=run,
    options={"points": "contact points"},
)
