# SPDX-License-Identifier: MIT
"""P9: a body on a wedge, pushed up, held or sliding down, by Coulomb friction."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.linear_host import LinearHost, NoEquilibriumError, Springs, make_driver
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Benchmark CGS-4 of NAFEMS: slope of the wedge, coefficient; weight of the body.
SLOPE, MU, WEIGHT = 0.1, 0.3, 1200.0

#: The slope down which it slides, for so long; standard gravity.
STEEP, TIME, GRAVITY = 0.75, 1.25, 9.80665

#: Allowable elastic slip; motion of the far ends of the springs, which shorten by SOFT each WEIGHT.
ALLOWABLE, PUSH, SOFT = 1e-3, 0.03, 0.01

#: No unknown is as large: motions are below 10, the force about half the weight.
_REACH = 1e4

#: Halvings of the interval in which the limit slope is looked for.
_HALVINGS = 56


def push() -> float:
    """Horizontal force over weight that pushes the body up the wedge."""
    return (SLOPE + MU) / (1.0 - MU * SLOPE)


def acceleration() -> float:
    """Acceleration of the body down the steep slope, length/time^2."""
    return GRAVITY * (STEEP - MU) / math.hypot(1.0, STEEP)


def _weights(points: int) -> np.ndarray:
    """One body a contact point, with weights that differ; areas are 1."""
    return WEIGHT * (1.0 + 0.5 * np.sin(np.arange(points)))


def _angle(slope: float) -> tuple[float, float]:
    """Cosine and sine."""
    return 1.0 / math.hypot(1.0, slope), slope / math.hypot(1.0, slope)


def _pushed(
    routine: Routine, points: int, lagrange: bool, steps: int
) -> tuple[LinearHost, dict[str, float]]:
    """What friction adds to the force while the bodies are moved up by springs: unknowns are their
    motions and the forces."""
    cosine, sine = _angle(SLOPE)
    one, weights = np.eye(points), _weights(points)
    nothing = np.zeros_like(one)
    springs = Springs(
        slip=np.hstack([one, nothing]),
        friction=np.vstack([one, nothing]),
        stiffness=np.block([[nothing, -cosine * one], [one, SOFT / WEIGHT * one]]),
        pressure=cosine * weights,
        pressure_change=np.hstack([nothing, sine * one]),
    )
    driver = make_driver(
        routine, [MU], points, directions=2, allowable=ALLOWABLE, lagrange=lagrange
    )
    host, worst = LinearHost(driver, springs, _REACH), 0.0
    for i in range(steps):
        motion = PUSH * (i + 1.0) / steps
        x = host.solve(np.concatenate([-sine * weights, np.full(points, motion)]))
        if motion > SOFT + ALLOWABLE:  # before, a body may still stick
            friction = (x[points:] / weights - SLOPE) / (push() - SLOPE)
            worst = max(worst, float(np.abs(friction - 1.0).max()))
    return host, {"force": worst}


def _host_on(routine: Routine, points: int, lagrange: bool, slope: float) -> LinearHost:
    """The bodies on a slope: their motions downward are the unknowns."""
    cosine, _ = _angle(slope)
    one = np.eye(points)
    springs = Springs(one, one, np.zeros_like(one), cosine * _weights(points))
    driver = make_driver(
        routine, [MU], points, directions=2, allowable=ALLOWABLE, lagrange=lagrange
    )
    return LinearHost(driver, springs, _REACH)


def _limit(routine: Routine, points: int, lagrange: bool) -> tuple[LinearHost, float]:
    """The largest slope on which the bodies rest, by bisection; each trial from a fresh contact."""
    host, weights = _host_on(routine, points, lagrange, 0.0), _weights(points)
    start = host.driver.state.save()
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        slope = 0.5 * (low + high)
        cosine, sine = _angle(slope)
        host.driver.state.load(start)
        host.unknowns, host.stress = np.zeros(points), np.zeros(points)
        host.driver.bind(pressure=cosine * weights)
        try:
            host.solve(sine * weights)
            low = slope
        except NoEquilibriumError:
            high = slope
    return host, low


def _slid(
    routine: Routine, points: int, lagrange: bool, steps: int
) -> tuple[LinearHost, dict[str, float]]:
    """What friction takes from velocity and distance of bodies that slide from rest; the implicit
    midpoint rule is exact here."""
    _, sine = _angle(STEEP)
    weights, dt = _weights(points), TIME / steps
    host = _host_on(routine, points, lagrange, STEEP)
    if not lagrange:  # the elastic slip at its limit, as if friction were rigid-plastic
        rigid = 1e30
        host.solve(np.full(points, rigid * ALLOWABLE), stiffness=rigid * np.eye(points))
    mass = weights / GRAVITY
    inertia = np.diag(2.0 * mass / dt**2)
    velocity, start = np.zeros(points), host.unknowns
    for _ in range(steps):
        before = host.unknowns
        load = sine * weights + inertia @ before + 2.0 * mass / dt * velocity
        velocity = 2.0 * (host.solve(load, dt, inertia) - before) / dt - velocity
    free = GRAVITY * sine
    taken = free - acceleration()
    moved = (host.unknowns - start) / (0.5 * TIME**2)
    return host, {
        "velocity": float(np.abs((free - velocity / TIME) / taken - 1.0).max()),
        "distance": float(np.abs((free - moved) / taken - 1.0).max()),
    }


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 16,
    steps: int = 10,
) -> Outcome:
    """One run against the closed form."""
    kind, _, enforcement = method.partition(" ")
    lagrange = enforcement == "lagrange"
    if kind == "limit":
        host, slope = _limit(routine, points, lagrange)
        errors, what, step = {"slope": abs(slope / MU - 1.0)}, "limit slope", 1.0
    elif kind == "wedge":
        host, errors = _pushed(routine, points, lagrange, steps)
        what, step = "force of friction", 1.0
    else:
        host, errors = _slid(routine, points, lagrange, steps)
        what, step = "lost velocity and distance", TIME / steps
    return Outcome(
        problem="P9", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=step, points=points,
        error=float(np.max(list(errors.values()))), error_of=what, tolerance=1e-13,
        details={**errors, "newton_iterations": host.iterations / max(1, host.increments)},
        **host.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P9",
    title="Body on a wedge: pushed up, resting at the limit, sliding down",
    statement="A body of weight G lies on a wedge; coefficient 0.3. Pushed up a slope of 0.1 by a "
    "horizontal force, it needs (tan a + mu)/(1 - mu tan a) G. It rests as long as the slope is "
    "not above the coefficient. On a slope of 0.75 it slides with g (sin a - mu cos a).",
    laws=("coulomb",),
    methods={
        "fric": ("wedge", "limit", "incline"),
        "fric_coef": (
            "wedge", "wedge lagrange", "limit", "limit lagrange", "incline", "incline lagrange",
        ),
    },
    runner=run,
    options={"points": "bodies, of one contact point each", "steps": "increments"},
)  # fmt: skip
