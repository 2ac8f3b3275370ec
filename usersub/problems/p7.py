# SPDX-License-Identifier: MIT
"""P7: a block on a shaken base."""

from __future__ import annotations

import math

import numpy as np

from usersub.problems.problem import Problem
from usersub.problems.slider import Event, State, bisect
from usersub.problems.slider_runs import METHODS, OPTIONS, Slider

MASS, GRAVITY, MU = 1.0, 10.0, 0.1

#: Acceleration of the base: amplitude and circular frequency; chosen so that the block both sticks
#: and slips in every half period.
SHAKE, FREQUENCY = 1.5, 2.0 * math.pi

#: Half periods that are compared.
HALVES = 6

#: A time between the rest of one half period and the slip of the next.
_BETWEEN = 0.1

#: The block on a penalty spring may stick for a moment within this time of breaking loose.
_LOOSE = 0.2


def base(time: float) -> tuple[float, float, float]:
    """Displacement, velocity and acceleration of the base, which starts at rest."""
    phase, ratio = FREQUENCY * time, SHAKE / FREQUENCY
    displacement = ratio * (time - math.sin(phase) / FREQUENCY)
    return displacement, ratio * (1.0 - math.cos(phase)), SHAKE * math.sin(phase)


class Block:
    """The block; all displacements are absolute."""

    masses = np.array([MASS])
    normal_force = MASS * GRAVITY
    start: State = (np.zeros(1), np.zeros(1))
    breaks: tuple[float, ...] = ()

    def ground(self, time: float) -> tuple[float, float, float]:
        """The base."""
        return base(time)

    def forces(self, x: np.ndarray, time: float) -> np.ndarray:
        """None but friction."""
        return np.zeros(1)

    def slide(self, state: State, time: float, friction: float, dt: float) -> State:
        """Constant acceleration."""
        (x, v), a = state, friction / MASS
        return x + v * dt + 0.5 * a * dt**2, v + a * dt

    def stick(self, state: State, time: float, dt: float) -> State:
        """With the base."""
        moved = base(time + dt)[0] - base(time)[0]
        return state[0] + moved, np.array([base(time + dt)[1]])


def exact() -> dict[str, float]:
    """Times of slip and rest, and the slip of every half period.

    The block lags behind from sin(omega t) = mu g/a on, with the acceleration mu g, until the base
    has its velocity again; half a period later the same happens the other way round.
    """
    limit = MU * GRAVITY
    slip = math.asin(limit / SHAKE) / FREQUENCY
    x, v, _ = base(slip)
    fast = bisect(lambda t: base(slip + t)[1] > v + limit * t, 1e-3, 0.49)
    lag = base(slip + fast)[0] - x - v * fast - 0.5 * limit * fast**2
    numbers: dict[str, float] = {}
    for i in range(HALVES):
        later = 0.5 * i * 2.0 * math.pi / FREQUENCY
        numbers[f"slip{i + 1}"] = slip + later
        numbers[f"rest{i + 1}"] = slip + fast + later
        numbers[f"lag{i + 1}"] = -lag if i % 2 == 0 else lag
    return numbers


def _measure(events: list[Event]) -> dict[str, float]:
    """The first rest of a half period that is none of breaking loose, on a penalty spring."""
    numbers: dict[str, float] = {}
    for i in range(HALVES):
        here = [e for e in events if _BETWEEN <= e.time - i * math.pi / FREQUENCY < _BETWEEN + 0.5]
        slip = next(e for e in here if e.kind == "slip")
        rest = next(e for e in here if e.kind == "rest" and e.time > slip.time + _LOOSE)
        apart = [e.x[0] - base(e.time)[0] for e in (slip, rest)]
        numbers[f"slip{i + 1}"], numbers[f"rest{i + 1}"] = slip.time, rest.time
        numbers[f"lag{i + 1}"] = apart[1] - apart[0]
    return numbers


SLIDER = Slider(
    name="P7",
    system=Block(),
    props={"coulomb": [MU]},
    static=MU,
    end=HALVES * math.pi / FREQUENCY + 0.1,
    measure=_measure,
    exact=exact(),
    compared="slip, rest and lag of 6 half periods",
    allowable=1e-14,
    slope=1e5,
    damping=0.05 * 2.0 * math.sqrt(1e5 * MASS),
    steps={"kinematic": 3000, "penalty": 3000},
    tolerance={"kinematic": 1e-2, "penalty": 2e-2},
)

PROBLEM = Problem(
    name="P7",
    title="Block on a shaken base",
    statement="A block of mass 1 under a gravity of 10 rests on a base, coefficient 0.1, whose "
    "acceleration is 1.5 sin(2 pi t). It slips back and forth in every period. When does it slip, "
    "when does it rest again, and how far does it slip?",
    laws=("coulomb",),
    methods=METHODS,
    runner=SLIDER.run,
    options=OPTIONS,
)
