# SPDX-License-Identifier: MIT
"""P5: an oscillator that Coulomb friction brings to rest after a finite time."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from usersub.problems.problem import Problem
from usersub.problems.slider import Event, Fixed, State, oscillation
from usersub.problems.slider_runs import HOLD, METHODS, OPTIONS, Slider

MASS, STIFFNESS, NORMAL_FORCE, MU, START = 1.0, 1e4, 50.0, 0.2, 8.55e-3

FREQUENCY = math.sqrt(STIFFNESS / MASS)

#: Half the width of the band in which the mass may rest.
BAND = MU * NORMAL_FORCE / STIFFNESS


class Rest(NamedTuple):
    """Half cycles, time and place of the last rest."""

    half_cycles: int
    time: float
    place: float


def exact() -> Rest:
    """Every half cycle takes pi/omega and moves the turning point 2D inwards."""
    n = math.ceil((START - BAND) / (2.0 * BAND))
    return Rest(n, n * math.pi / FREQUENCY, (-1) ** n * (START - 2 * n * BAND))


class Oscillator(Fixed):
    """A mass on a spring."""

    masses = np.array([MASS])
    normal_force = NORMAL_FORCE
    start: State = (np.array([START]), np.array([0.0]))

    def forces(self, x: np.ndarray, time: float) -> np.ndarray:
        """The spring's."""
        return -STIFFNESS * x

    def slide(self, state: State, time: float, friction: float, dt: float) -> State:
        """About a centre that friction has moved."""
        return oscillation(*state, friction / STIFFNESS, FREQUENCY, dt)

    def stick(self, state: State, time: float, dt: float) -> State:
        """It rests."""
        return state[0].copy(), np.zeros(1)


def _measure(events: list[Event]) -> dict[str, float]:
    last = [event for event in events if event.kind == "rest"][-1]
    return {"time": last.time, "place": last.x[0]}


_EXACT = exact()

SLIDER = Slider(
    name="P5",
    system=Oscillator(),
    props={"coulomb": [MU]},
    static=MU,
    end=1.2 * _EXACT.time,
    measure=_measure,
    exact={"time": _EXACT.time, "place": _EXACT.place},
    allowable=1e-13 * BAND,
    slope=3e3 * STIFFNESS,
    damping=0.1 * 2.0 * math.sqrt(3e3 * STIFFNESS * MASS),
    steps={"kinematic": 1500, "penalty": 4500},
    tolerance={"kinematic": 5e-3, "penalty": 2e-2},
)

PROBLEM = Problem(
    name="P5",
    title="Oscillator stopped by Coulomb friction",
    statement="A mass of 1 on a spring of stiffness 1e4, pressed on its ground so that friction is "
    "10, starts at rest 8.55e-3 away from the spring's neutral place. The amplitude falls by "
    "4 mu N/k a cycle. When and where does it rest for ever? It rests where the spring still "
    "pulls, and must not creep.",
    laws=("coulomb",),
    methods=METHODS,
    runner=SLIDER.run,
    options=OPTIONS | HOLD,
)
