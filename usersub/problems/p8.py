# SPDX-License-Identifier: MIT
"""P8: stick-slip of a mass that a spring pulls along."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from usersub.problems.problem import Problem
from usersub.problems.slider import Event, Fixed, State, oscillation
from usersub.problems.slider_runs import METHODS, OPTIONS, Slider

MASS, STIFFNESS, SPEED, NORMAL_FORCE = 1.0, 100.0, 0.1, 10.0

#: Friction force at rest and in motion.
STATIC, KINETIC = 3.0, 2.0

FREQUENCY = math.sqrt(STIFFNESS / MASS)

#: Whole cycles that are compared.
CYCLES = 20


class Pulled(Fixed):
    """A mass on a spring whose other end moves at a constant speed."""

    masses = np.array([MASS])
    normal_force = NORMAL_FORCE
    start: State = (np.zeros(1), np.zeros(1))

    def forces(self, x: np.ndarray, time: float) -> np.ndarray:
        """The spring's."""
        return STIFFNESS * (SPEED * time - x)

    def slide(self, state: State, time: float, friction: float, dt: float) -> State:
        """Seen from the end of the spring it swings about a constant place."""
        x, v = oscillation(
            state[0] - SPEED * time, state[1] - SPEED, friction / STIFFNESS, FREQUENCY, dt
        )
        return x + SPEED * (time + dt), v + SPEED

    def stick(self, state: State, time: float, dt: float) -> State:
        """It rests."""
        return state[0].copy(), np.zeros(1)


def exact() -> dict[str, float]:
    """Durations of stick and slip, the jump of a cycle, and how late the last cycle may be.

    The spring is stretched by 2a more at the slip than at the rest, a = (Fs - Fk)/k.
    """
    a = (STATIC - KINETIC) / STIFFNESS
    stick = 2.0 * a / SPEED
    slip = 2.0 / FREQUENCY * (math.pi - math.atan(a * FREQUENCY / SPEED))
    first = STATIC / (STIFFNESS * SPEED)
    period = stick + slip
    return {
        "stick": stick, "slip": slip, "jump": SPEED * period, "last": first + CYCLES * period,
    }  # fmt: skip


def _measure(events: list[Event]) -> dict[str, float]:
    slips = [e for e in events if e.kind == "slip"][: CYCLES + 1]
    rests = [next(r for r in events if r.kind == "rest" and r.time > s.time) for s in slips[:-1]]
    worst = {
        "stick": [b.time - r.time for r, b in zip(rests, slips[1:], strict=True)],
        "slip": [r.time - s.time for r, s in zip(rests, slips, strict=False)],
        "jump": [b.x[0] - s.x[0] for s, b in pairwise(slips)],
    }
    answer = exact()
    numbers = {
        name: max(found, key=lambda x, name=name: abs(x - answer[name]))
        for name, found in worst.items()
    }
    return {**numbers, "last": slips[CYCLES].time}


SLIDER = Slider(
    name="P8",
    system=Pulled(),
    props={"exponential_decay": [STATIC / NORMAL_FORCE, KINETIC / NORMAL_FORCE, 1e30]},
    static=STATIC / NORMAL_FORCE,
    end=exact()["last"] + 0.1,
    measure=_measure,
    exact=exact(),
    allowable=1e-14,
    slope=1e5,
    damping=0.1 * 2.0 * math.sqrt(1e5 * MASS),
    steps={"kinematic": 7000, "penalty": 7000},
    tolerance={"kinematic": 4e-2, "penalty": 3e-2},
)

PROBLEM = Problem(
    name="P8",
    title="Stick-slip of a pulled mass",
    statement="A mass of 1 on a spring of 100 whose other end moves at 0.1; friction is 3 at rest "
    "and 2 in motion. How long does it stick and slip, how far does it jump, and does the phase "
    "drift over many cycles? Numbers are the worst of 20 cycles.",
    laws=("exponential_decay",),
    methods=METHODS,
    runner=SLIDER.run,
    options=OPTIONS,
)
