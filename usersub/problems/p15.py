# SPDX-License-Identifier: MIT
"""P15: rate and state friction after a step of the velocity."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from usersub.errors import SceneError
from usersub.problems import own
from usersub.problems.path_host import PRESSURE, Path, outcome, worst
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficient at the rate V0 = 1, direct effect, effect of the state; rates before and after.
MU, A, B, BEFORE, AFTER = 0.6, 0.005, 0.01, 1.0, 10.0

#: Slip that renews the contacts; allowable elastic slip of penalty enforcement.
DISTANCE, _ALLOWABLE = 2.0, 1e-3

#: Slips after the step where the coefficient is compared: at once, on the way, at the end.
_SLIPS = (1e-3, 0.1, 0.7, 2.0, 5.0, 100.0)

#: Slip in equal increments, over the distance; what increments of h of it add to the error of the
#: coefficient at most: so much times h, or h^2.
_SLIDE, _ERROR = 4.0, 0.02

_TOLERANCES = {"double": 1e-12, "single": 1e-5}


def state(law: str, slip: float) -> float:
    """theta at a slip after the step; before it Dc/BEFORE."""
    old, new, share = DISTANCE / BEFORE, DISTANCE / AFTER, math.exp(-slip / DISTANCE)
    if law == "rate_state_slip":
        return new * (old / new) ** share
    return new + (old - new) * share


def coefficient(law: str, slip: float) -> float:
    """The coefficient at a slip after the step."""
    logarithmic = MU + A * math.log(AFTER) + B * math.log(state(law, slip) / DISTANCE)
    if law != "rate_state_regularised":
        return logarithmic
    # asinh(e^x/2) = x + ln((1 + sqrt(1 + 4 e^-2x))/2), where e^-2x is far below rounding
    x = logarithmic / A
    return A * (x + math.log1p(math.sqrt(1.0 + 4.0 * math.exp(-2.0 * x))) - math.log(2.0))


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 8,
    steps: int | None = None,
    update: str = "",
) -> Outcome:
    """One run against the closed forms."""
    own.check_steps("P15", law, steps, update)
    if update and steps is None:
        raise SceneError(f"problem P15: the update '{update}' needs steps")
    props, tolerance = [MU, A, B, 1.0, DISTANCE, DISTANCE / BEFORE], _TOLERANCES[precision]
    if law != "rate_state_regularised":
        props.append(1e-9)
    slips = _SLIPS
    if steps:
        slips = tuple(_SLIDE * DISTANCE * (k + 1) / steps for k in range(steps))
    if update:
        weight = own.UPDATES[law][1][update]
        props.append(weight)
        order = 2 if weight == 0.5 else 1
        tolerance += _ERROR * (_SLIDE / len(slips)) ** order
    path = Path(routine, law, props, points, precision, _ALLOWABLE)
    steady = path.move(1.0, 1.0 / BEFORE) / PRESSURE
    slip, errors = 0.0, {"before": worst(steady, MU + (A - B) * math.log(BEFORE)), "after": 0.0}
    for place in slips:
        found = path.move(place - slip, (place - slip) / AFTER) / PRESSURE
        slip = place
        errors["after"] = max(errors["after"], worst(found, coefficient(law, slip)))
    if not steps:
        errors["steady"] = worst(found, MU + (A - B) * math.log(AFTER / BEFORE))
    return outcome(
        "P15", routine, law, precision, method, path, errors, tolerance,
        (slips[-1] - slips[-2]) / AFTER if len(slips) > 1 else slips[0] / AFTER, "coefficient",
    )  # fmt: skip


PROBLEM = Problem(
    name="P15",
    title="Rate and state friction after a step of the velocity",
    statement="Contact points slide steadily at the rate 1, then at 10. The coefficient jumps by "
    "a ln 10, decays with the slip as the state does, and settles at 0.588487075. Exact for any "
    "increments.",
    laws=("rate_state_ageing", "rate_state_slip", "rate_state_regularised"),
    methods=dict.fromkeys(("fric", "fric_coef", "vfric", "vfriction"), ("rigid load",)),
    runner=run,
    options={
        "points": "contact points",
        "steps": "equal increments after the step, instead of some that differ",
        "update": "how the state of rate_state_ageing is updated: explicit Euler, trapezoidal "
        "rule, implicit Euler; exactly if not given",
    },
    updates={"rate_state_ageing": {"rigid load": tuple(own.UPDATES["rate_state_ageing"][1])}},
)
