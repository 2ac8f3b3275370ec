# SPDX-License-Identifier: MIT
"""P6: two masses on a spring, one of which rubs; static and kinetic coefficient differ."""

from __future__ import annotations

import math

import numpy as np

from usersub.problems.problem import Problem
from usersub.problems.slider import Event, Fixed, State, oscillation
from usersub.problems.slider_runs import METHODS, OPTIONS, Slider

MASS, STIFFNESS, NORMAL_FORCE, STATIC, KINETIC = 5.0, 1e4, 1e4, 0.3, 0.2

#: Force on the mass that does not rub, and when it ends.
PULL, END_OF_PULL = 3e3, 0.2

#: The kinetic coefficient rules at any slip rate: the decay is over at once.
AT_ONCE = 1e30


class Pair(Fixed):
    """The mass that rubs and the one that is pulled, with a spring between them."""

    masses = np.array([MASS, MASS])
    normal_force = NORMAL_FORCE
    start: State = (np.zeros(2), np.zeros(2))
    breaks = (END_OF_PULL,)

    def pull(self, time: float) -> float:
        """The force at a time."""
        return PULL if time < END_OF_PULL else 0.0

    def forces(self, x: np.ndarray, time: float) -> np.ndarray:
        """The spring's and the pull."""
        spring = STIFFNESS * (x[1] - x[0])
        return np.array([spring, self.pull(time) - spring])

    def slide(self, state: State, time: float, friction: float, dt: float) -> State:
        """Centre of mass under a constant force, distance of the masses about a constant one."""
        (x1, x2), (v1, v2) = state
        pull = self.pull(time)
        acceleration = (pull + friction) / (2.0 * MASS)
        velocity = 0.5 * (v1 + v2) + acceleration * dt
        centre = 0.5 * (x1 + x2) + 0.5 * (v1 + v2) * dt + 0.5 * acceleration * dt**2
        stretch = (pull - friction) / (2.0 * STIFFNESS)
        r, s = oscillation(x2 - x1, v2 - v1, stretch, math.sqrt(2.0 * STIFFNESS / MASS), dt)
        half = np.array([-0.5, 0.5])
        return centre + half * r, velocity + half * s

    def stick(self, state: State, time: float, dt: float) -> State:
        """The pulled mass swings alone."""
        (x1, x2), (_, v2) = state
        centre = x1 + self.pull(time) / STIFFNESS
        x, v = oscillation(x2, v2, centre, math.sqrt(STIFFNESS / MASS), dt)
        return np.array([x1, x]), np.array([0.0, v])


def exact() -> dict[str, float]:
    """When the first mass breaks loose, where both are when the pull ends, and the rest.

    Until the first slip the pulled mass swings alone, and the spring carries F (1 - cos). The rest
    is the zero of the velocity after the pull has ended, by bisection of its closed form.
    """
    system, single = Pair(), math.sqrt(STIFFNESS / MASS)
    slip = math.acos(1.0 - STATIC * NORMAL_FORCE / PULL) / single
    stretch = STATIC * NORMAL_FORCE / STIFFNESS
    speed = PULL / STIFFNESS * single * math.sin(single * slip)
    loose = (np.array([0.0, stretch]), np.array([0.0, speed]))
    friction = -KINETIC * NORMAL_FORCE
    ended = system.slide(loose, slip, friction, END_OF_PULL - slip)
    low, high = 0.10, 0.12
    while low < (middle := 0.5 * (low + high)) < high:
        moving = system.slide(ended, END_OF_PULL, friction, middle)[1][0] > 0.0
        low, high = (middle, high) if moving else (low, middle)
    rest = system.slide(ended, END_OF_PULL, friction, low)
    (x1, x2), (v1, v2) = ended
    return {
        "slip": slip, "x1": x1, "v1": v1, "x2": x2, "v2": v2,
        "rest": END_OF_PULL + low, "place": rest[0][0],
    }  # fmt: skip


def _measure(events: list[Event]) -> dict[str, float]:
    slip = next(event for event in events if event.kind == "slip")
    ended = next(event for event in events if event.kind == "break")
    rest = next(event for event in events if event.kind == "rest" and event.time > ended.time)
    return {
        "slip": slip.time, "x1": ended.x[0], "v1": ended.v[0], "x2": ended.x[1], "v2": ended.v[1],
        "rest": rest.time, "place": rest.x[0],
    }  # fmt: skip


SLIDER = Slider(
    name="P6",
    system=Pair(),
    props={"exponential_decay": [STATIC, KINETIC, AT_ONCE]},
    static=STATIC,
    end=0.4,
    measure=_measure,
    exact=exact(),
    allowable=1e-12,
    slope=1e3 * STIFFNESS,
    damping=0.1 * 2.0 * math.sqrt(1e3 * STIFFNESS * MASS),
    steps={"kinematic": 2000, "penalty": 4000},
    tolerance={"kinematic": 1e-2, "penalty": 1e-2},
)

PROBLEM = Problem(
    name="P6",
    title="Two masses, static and kinetic friction",
    statement="Two masses of 5, with a spring of 1e4 between them; the first rests under a normal "
    "force of 1e4 with the coefficients 0.3 at rest and 0.2 in motion, the second is free and "
    "pulled by 3e3 for 0.2 s. When does the first mass slip, where and how fast are both when the "
    "pull ends, when and where does the first come to rest again?",
    laws=("exponential_decay",),
    methods=METHODS,
    runner=SLIDER.run,
    options=OPTIONS,
)
