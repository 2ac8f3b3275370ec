# SPDX-License-Identifier: MIT
"""P13: bristles before and in slip: start, steady loops, their energy, and creep in small loops."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.errors import SceneError
from usersub.problems import own
from usersub.problems.path_host import PRESSURE, Path, outcome, worst
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Strength of the bristle, its stiffness, half the length of a loop.
STRENGTH, STIFFNESS, REACH = 2.0, 1e3, 3e-3

#: Static coefficient and Stribeck velocity of LuGre, damping, viscosity, slip rate.
_STATIC, _VELOCITY, _DAMPING, _VISCOSITY, _RATE = 0.9, 0.02, 3.0, 0.7, 0.01

#: Motion in equal increments, by the bend at the strength.
_SLIDE = 4.0

#: Bend up to which the elasto-plastic bristle is elastic.
_BREAKAWAY = 0.7

#: Loops until they are steady: a loop leaves exp(-4 STIFFNESS REACH/STRENGTH) of what was before.
_LOOPS, _NODES = 12, 20

#: Rounding of a path of some hundred increments.
_TOLERANCES = {"double": 1e-12, "single": 1e-4}


def loop(strength: float) -> tuple[float, float]:
    """Traction at the ends of a steady loop, and its work, per area."""
    ratio = STIFFNESS * REACH / strength
    tip = strength * math.tanh(ratio)
    return tip, 4.0 * strength * (REACH - tip / STIFFNESS)


def start(motion: float, strength: float) -> float:
    """Traction of a bristle without damping, from rest."""
    return -strength * math.expm1(-STIFFNESS * motion / strength)


def _strength(law: str, rate: float) -> float:
    """Strength at a slip rate; the kinetic one is STRENGTH."""
    if law == "dahl":
        return STRENGTH
    kinetic = STRENGTH / PRESSURE
    return PRESSURE * (kinetic + (_STATIC - kinetic) * math.exp(-((rate / _VELOCITY) ** 2)))


def _props(law: str, damped: bool) -> list[float]:
    kinetic = STRENGTH / PRESSURE
    if law == "dahl":
        return [kinetic, STIFFNESS]
    damping = [_DAMPING, _VISCOSITY] if damped and law == "lugre" else [0.0, 0.0]
    if law == "lugre":
        return [_STATIC, kinetic, _VELOCITY, 2.0, STIFFNESS, *damping]
    return [kinetic, kinetic, _VELOCITY, 2.0, STIFFNESS, *damping, _BREAKAWAY]


def _started(path: Path, law: str, steps: int | None) -> dict[str, float]:
    """From rest into steady slip at a constant rate, in increments of very different lengths, or in
    equal ones up to where the strength is nearly reached."""
    motion, error = 0.0, 0.0
    strength, damped = _strength(law, _RATE), law == "lugre"
    lengths = (1e-9, 3e-5, 4e-4, 2e-3, 1e-4, 5e-3, 4.0)
    if steps is not None:
        lengths = (_SLIDE * STRENGTH / STIFFNESS / steps,) * steps
    for length in lengths:
        motion += length
        exact = start(motion, strength)
        if damped:
            share = math.exp(-STIFFNESS * motion / strength)
            exact += _RATE * (_DAMPING * share + _VISCOSITY)
        error = max(error, worst(path.move(length, length / _RATE), exact))
    return {"start": error}


def _looped(path: Path, law: str, steps: int | None) -> dict[str, float]:
    """Loops between two ends; increments from one Gauss point to the next, for the work."""
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    stops = np.concatenate([[-1.0], nodes, [1.0]])
    path.move(-REACH, REACH / _RATE)
    work, tips = np.zeros(path.points), np.zeros(path.points)
    for half in range(2 * _LOOPS):
        way = 1.0 if half % 2 == 0 else -1.0
        found = [path.move(way * REACH * d, REACH * d / _RATE) for d in np.diff(stops)]
        if half >= 2 * _LOOPS - 2:
            work += REACH * way * np.einsum("i,ik->k", weights, np.array(found[:-1]))
            tips = np.maximum(tips, np.abs(found[-1]))
    tip, exact = loop(_strength(law, _RATE))
    return {"ends": worst(tips, tip), "work": worst(work, exact)}


def bend_length(bend: float) -> float:
    """Motion that bends the elasto-plastic bristle from its breakaway to `bend`, both over the
    limit: integral of 1/(1 - alpha z), by Gauss quadrature over the logarithm of what is left."""
    nodes, weights = np.polynomial.legendre.leggauss(64)
    low, high = math.log(1.0 - bend), math.log(1.0 - _BREAKAWAY)
    left = np.exp(0.5 * (high + low) + 0.5 * (high - low) * nodes)
    middle, width = 0.5 * (1.0 + _BREAKAWAY), 1.0 - _BREAKAWAY
    alpha = 0.5 * (1.0 + np.sin(np.pi * (1.0 - left - middle) / width))
    return 0.5 * (high - low) * float(weights @ (left / (1.0 - alpha * (1.0 - left))))


def _broken(path: Path) -> dict[str, float]:
    """Elasto-plastic: elastic up to the breakaway, then the published slip."""
    limit, errors, before = STRENGTH / STIFFNESS, {"elastic": 0.0, "slip": 0.0}, 0.0
    for bend in (0.2, 0.6, 0.75, 0.9, 0.99, 1.0 - 1e-9):
        way = bend if bend < _BREAKAWAY else _BREAKAWAY + bend_length(bend)
        found = path.move((way - before) * limit, 0.1)
        name, before = "elastic" if bend < _BREAKAWAY else "slip", way
        errors[name] = max(errors[name], worst(found, bend * STRENGTH))
    return errors


def _held(path: Path) -> dict[str, float]:
    """Elasto-plastic: small loops about a mean neither creep nor take work."""
    limit, swing = STRENGTH / STIFFNESS, 0.3
    path.move(0.6 * limit, 0.1)
    for _ in range(100):
        path.move(-swing * limit, 0.1)
        found = path.move(swing * limit, 0.1)
    return {"creep": worst(found, 0.6 * STRENGTH)}


_RUNNERS = {
    ("dahl", "start"): (_started, "traction"),
    ("lugre", "start"): (_started, "traction"),
    ("elasto_plastic", "start"): (lambda path, *_: _broken(path), "traction"),
    ("dahl", "loop"): (_looped, "ends and work of the loop"),
    ("lugre", "loop"): (_looped, "ends and work of the loop"),
    ("elasto_plastic", "loop"): (lambda path, *_: _held(path), "creep in loops"),
}


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
    own.check_steps("P13", law, steps, update)
    if update and (steps is None or method != "start"):
        raise SceneError(
            f"problem P13: the update '{update}' needs steps, and is for 'start' alone"
        )
    props, tolerance = _props(law, method == "start"), _TOLERANCES[precision]
    if update:
        theta = own.UPDATES[law][1][update]
        props.append(theta)
        # The relative error is largest in the first increment: h/2, or h^2/12.
        h = _SLIDE / (steps or 1)
        tolerance += 0.1 * h**2 if theta == 0.5 else 0.6 * h
    path = Path(routine, law, props, points, precision)
    runner, error_of = _RUNNERS[law, method]
    stepped = steps and method == "start" and law != "elasto_plastic"
    length = _SLIDE * STRENGTH / STIFFNESS / (steps or 1)
    return outcome(
        "P13", routine, law, precision, method, path, runner(path, law, steps), tolerance,
        length / _RATE if stepped else 0.4, error_of,
    )  # fmt: skip


_METHODS = ("start", "loop")

PROBLEM = Problem(
    name="P13",
    title="Bristle before and in slip, and its loops",
    statement="Contact points are moved from rest into steady slip, and forth and back by 3e-3. "
    "Strength 2, stiffness of the bristle 1e3. Traction at the ends of the steady loop 1.8102965, "
    "work 9.5176279e-3. An elasto-plastic bristle does not creep in small loops about a mean.",
    laws=("dahl", "lugre", "elasto_plastic"),
    methods=dict.fromkeys(("fric", "vfric", "vfriction"), _METHODS),
    runner=run,
    options={
        "points": "contact points",
        "steps": "equal increments from rest, instead of some that differ (dahl and lugre, start)",
        "update": "how dahl's state is updated: explicit Euler, trapezoidal rule, implicit Euler; "
        "exactly if not given",
    },
    updates={"dahl": {"start": tuple(own.UPDATES["dahl"][1])}},
)
