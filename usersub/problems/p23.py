# SPDX-License-Identifier: MIT
"""P23: the rigid block of P1 with softened tangential behaviour, with and without a bound."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.errors import SceneError
from usersub.problems.block import Block
from usersub.problems.problem import Outcome, Problem
from usersub.problems.soft_block import ExplicitBlock, Host, ImplicitBlock, Turn, turns

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

BLOCK = Block()
MU = 0.15

#: Slope of the shear stress over the elastic slip, in psi/in.
SLOPE = 1e4

FREQUENCY = math.sqrt(SLOPE * BLOCK.area / BLOCK.mass)

#: A coefficient that is never reached stands for rough friction.
_ROUGH = 1e6

#: Half swings that are compared.
_HALF_SWINGS = 8

#: Relative error in `_STEPS` increments: (omega dt)^2/24 of the frequency, and the bend where the
#: slip begins and ends.
_STEPS = 2000
_TOLERANCE = 2e-4

#: What a law stands for.
_VARIANTS = {
    "softened_rough": ("rough",),
    "softened": ("bounded",),
    "coulomb": ("rough", "bounded"),
}


def rough() -> dict[str, float]:
    """Harmonic motion with omega = sqrt(kappa A/m) and the amplitude v0/omega."""
    return {
        "amplitude": BLOCK.velocity / FREQUENCY,
        "last turn": (0.5 + _HALF_SWINGS) * math.pi / FREQUENCY,
    }


def bounded() -> dict[str, float]:
    """Elastic up to mu p, then slip under constant friction; from the stop on the block rings.

    The stress at the stop is mu p and the velocity zero, so the amplitude is mu p/kappa.
    """
    reach = MU * BLOCK.pressure / SLOPE
    slip = math.asin(FREQUENCY * reach / BLOCK.velocity) / FREQUENCY
    speed = math.sqrt(BLOCK.velocity**2 - (FREQUENCY * reach) ** 2)
    deceleration = MU * BLOCK.pressure * BLOCK.area / BLOCK.mass
    stop = slip + speed / deceleration
    return {
        "stop": stop,
        "place": reach + 0.5 * speed**2 / deceleration,
        "ring": reach,
        "last turn": stop + _HALF_SWINGS * math.pi / FREQUENCY,
    }


def _numbers(variant: str, found: list[Turn]) -> dict[str, float]:
    last = found[_HALF_SWINGS].time
    swing = 0.5 * (found[0].place - found[1].place)
    if variant == "rough":
        return {"amplitude": swing, "last turn": last}
    return {"stop": found[0].time, "place": found[0].place, "ring": swing, "last turn": last}


def _host(routine: Routine, law: str, variant: str, precision: str, points: int) -> Host:
    """The block with the law and the scene of a variant."""
    from usersub import laws

    face = routine.interface
    if law == "coulomb":
        props = [MU if variant == "bounded" else _ROUGH]
        settings: dict[str, object] = {"stick_slope": SLOPE}
        if face.name == "vfric_coef":
            settings["enforcement"] = "penalty"
    else:
        props = [SLOPE] if law == "softened_rough" else [MU, SLOPE]
        dimension = 2 if face.name == "vfric" else 3
        states = laws.LAWS[law].state_count(face.name, dimension - 1, dimension, props)
        settings = {"states": states}
    if face.solver == "standard":
        return ImplicitBlock(BLOCK, routine, props, points, **settings)
    return ExplicitBlock(BLOCK, routine, props, points, precision, **settings)


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 3,
    steps: int = _STEPS,
) -> Outcome:
    """One run of each variant that the law stands for."""
    if steps < 1:
        raise SceneError(f"problem P23: steps is {steps}, expected 1 or more")
    errors: dict[str, float] = {}
    increment = 0.0
    for variant in _VARIANTS[law]:
        exact = rough() if variant == "rough" else bounded()
        increment = 1.02 * exact["last turn"] / steps
        host = _host(routine, law, variant, precision, points)
        try:
            found = _numbers(variant, turns(host.trace(increment, steps), increment))
        except IndexError:  # too few turns
            found = {}
        for name, number in exact.items():
            error = abs(found.get(name, np.nan) / number - 1.0)
            errors[f"{variant} {name}"] = error
    tolerance = _TOLERANCE if precision == "double" else 2.0 * _TOLERANCE
    return Outcome(
        problem="P23", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=increment, points=points,
        error=float(np.max([*errors.values()])), error_of=", ".join(errors), tolerance=tolerance,
        details=errors, **host.watch.times(points),
    )  # fmt: skip


_TRACTION = ("softened", "softened_rough")

PROBLEM = Problem(
    name="P23",
    title="Rigid block on softened contact",
    statement="The block of P1, rigid, starts with 200 in/s on a contact whose shear stress grows "
    "with the elastic slip, 1e4 psi/in. Rough, it swings harmonically. With the bound mu p = 300 "
    "psi it slips from there on, stops, and rings about a place behind. Where and when does it "
    "turn?",
    laws=("coulomb", *_TRACTION),
    methods={
        "vfric": ("central differences",),
        "vfriction": ("central differences",),
        "vfric_coef": ("central differences",),
        "fric": ("trapezoidal rule",),
        "fric_coef": ("trapezoidal rule",),
    },
    runner=run,
    laws_by_interface={"vfric": _TRACTION, "vfriction": _TRACTION, "fric": _TRACTION},
    options={
        "points": "contact points that share the block",
        "steps": "increments of each run",
    },
)
