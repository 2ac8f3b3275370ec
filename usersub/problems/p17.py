# SPDX-License-Identifier: MIT
"""P17: a slider on a spring of the critical stiffness: rate and state friction, ageing law.

Quasi-static: spring and friction balance at all times. The increment of the host is symmetric: the
velocity of an increment is that which balances at its middle, where the driver is asked for half of
the increment and then cut back; the whole increment is committed with this velocity. The state is
exact for it, so the error is a series in even powers of the increment, and four sequences of
increments extrapolate it to the order 8.

With v = ln(V/V0), f = ln(V0 theta/Dc) and k = K Dc/p,

    a dv/dt = k (1 - e^v) - b (e^-f - e^v),  df/dt = e^-f - e^v   (time by Dc/V0)

and for k = b - a the sum  a (W - ln W) + k (e^f - f),  W = e^(v + f),  does not change.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import fixed
from usersub.problems.problem import Outcome, Problem, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Steady coefficient, direct effect, effect of the state; pressure. V0 = Dc = 1.
MU, A, B, PRESSURE = 0.6, 0.01, 0.015, 4.0
CRITICAL = B - A

#: Velocity at the start of the periodic motion, where the state is steady; periods.
VELOCITY, PERIODS = 1.5, 30

#: Steps in a period, and sequences of increments in each.
_STEPS, _SEQUENCE = 32, (1, 2, 3, 4)

#: Stiffness over the critical one, and the small disturbance that grows or fades.
STIFFNESSES, _SMALL = (0.8, 0.95, 1.05, 1.25), 1e-4

#: Drift over all periods; of the growth, whose part of second order in the disturbance is left.
_TOLERANCES = {"critical": 1e-6, "near critical": 1e-7}

_NEWTON_LIMIT, _NEWTON_ACCURACY = 40, 1e-9


def excess(v: np.ndarray | float, f: np.ndarray | float) -> np.ndarray | float:
    """What does not change at the critical stiffness, above its least value."""
    if not np.all(np.isfinite(v)) or not np.all(np.isfinite(f)):
        return np.nan
    return A * (np.expm1(v + f) - (v + f)) + CRITICAL * (np.expm1(f) - f)


def _root(square: float, positive: bool) -> float:
    """x of the asked sign with e^x - 1 - x = square."""
    x = math.sqrt(2.0 * square) if positive else -max(math.sqrt(2.0 * square), square)
    for _ in range(60):
        change = (math.expm1(x) - x - square) / math.expm1(x)
        x -= change
        if abs(change) <= 1e-15 * abs(x):
            break
    return x


def period(level: float, samples: int = 256) -> float:
    """Time of one cycle by quadrature along it, which converges like exp(-samples)."""
    total = 0.0
    for i in range(samples):
        s, c = math.sin(angle := 2.0 * math.pi * (i + 0.5) / samples), math.cos(angle)
        f = _root(level * s * s / CRITICAL, s > 0)
        w = _root(level * c * c / A, c > 0)
        rate = math.exp(-f) * math.expm1(w)
        total += 2.0 * level * s * c / (CRITICAL * math.expm1(f) * rate)
    return abs(total) * 2.0 * math.pi / samples


def linear(ratio: float) -> tuple[float, float]:
    """Growth rate and angular frequency of a small disturbance, by V0/Dc."""
    k = ratio * CRITICAL
    growth = 0.5 * (B - A - k) / A
    return growth, math.sqrt(k / A - growth**2)


class Sliders:
    """Sliders with springs, each on a contact point, in different directions.

    Args:
        stiffness: of the springs, times Dc over pressure.
        velocity: at the start, shape (points,); the state is the steady one of V0.
    """

    def __init__(
        self, routine: Routine, law: str, stiffness: np.ndarray, velocity: np.ndarray
    ) -> None:
        from usersub import Scene, StandardDriver, laws

        points, interface = velocity.size, routine.interface.name
        props = [MU, A, B, 1.0, 1.0, 1.0, 1e-12]
        allowable = 1e-3
        scene = Scene(
            points=points, dimension=3, props=props, characteristic_length=200.0 * allowable,
            states=laws.law(law).state_count(interface, 2, 3, props),
        )  # fmt: skip
        self.driver = StandardDriver(routine, scene, reuse=True)
        angle = 0.3 + 5.0 * np.arange(points) / points
        self.along = np.array([np.cos(angle), np.sin(angle)])
        self.motion = np.zeros((2, points), order="F")
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        self.driver.bind(slip_increment=self.motion, pressure=np.full(points, PRESSURE), **extra)
        for motion in (0.0, allowable):  # closes the contact, uses up the elastic slip
            self.motion[...] = motion * self.along
            self.driver.begin_increment(0.0)
            fixed.iterate(self.driver)
            self.driver.commit()
        self.state = self.driver.state["state"]
        self.stiffness, self.velocity = stiffness * PRESSURE, velocity.copy()
        self.start = PRESSURE * (MU + A * np.log(velocity))
        self.time, self.slip = 0.0, np.zeros(points)
        self.watch, self.calls = Stopwatch(), 0

    def _friction(self, motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Traction along each direction and its derivative by the motion."""
        self.motion[...] = motion * self.along
        with self.watch:
            response = fixed.iterate(self.driver)
        self.calls += 1
        tau, tangent = (response.tau * self.along).sum(0), response.ddtddg
        assert tangent is not None  # the scene has tangents
        return tau, np.einsum("ak,abk,bk->k", self.along, tangent, self.along)

    def spring(self, time: float, slip: np.ndarray) -> np.ndarray:
        """What the springs hold, by area."""
        return self.start + self.stiffness * (time - slip)

    def increment(self, dt: float) -> None:
        """One symmetric increment."""
        half, logarithm = 0.5 * dt, np.log(self.velocity)
        self.driver.begin_increment(half)
        for _ in range(_NEWTON_LIMIT):
            motion = np.exp(logarithm) * half
            tau, tangent = self._friction(motion)
            residual = tau - self.spring(self.time + half, self.slip + motion)
            change = residual / ((tangent + self.stiffness) * motion)
            logarithm = logarithm - np.clip(change, -1.0, 1.0)
            if not np.abs(change).max() > _NEWTON_ACCURACY:
                break
        self.driver.cut_back()
        self.velocity = np.exp(logarithm)
        self.driver.begin_increment(dt)
        self._friction(self.velocity * dt)
        self.driver.commit()
        self.slip, self.time = self.slip + self.velocity * dt, self.time + dt

    def step(self, dt: float) -> None:
        """Increments of several lengths over the same step, extrapolated to none."""
        begin = self.time, self.slip, self.velocity, self.state.copy()
        slips: list[np.ndarray] = []
        states: list[np.ndarray] = []
        for count in _SEQUENCE:
            self.time, self.slip, self.velocity = begin[:3]
            self.state[...] = begin[3]
            for _ in range(count):
                self.increment(dt / count)
            slips.append(self.slip - begin[1])
            states.append(self.state.copy())
        self.slip = begin[1] + _extrapolated(slips)
        self.state[-1] = _extrapolated(states)[-1]

    def phase(self) -> tuple[np.ndarray, np.ndarray]:
        """Logarithms of velocity and state now, of the balance and of the driver."""
        state = np.where(self.state[-1] > 0.0, self.state[-1], np.nan)  # there may be none
        f = np.log(state)
        v = (self.spring(self.time, self.slip) / PRESSURE - MU - B * f) / A
        return v, f


def _extrapolated(values: list[np.ndarray]) -> np.ndarray:
    """To increments of no length, by Aitken and Neville; only even powers of the length."""
    for level in range(1, len(values)):
        values = [
            fine + (fine - coarse) / ((_SEQUENCE[i + level] / _SEQUENCE[i]) ** 2 - 1.0)
            for i, (coarse, fine) in enumerate(zip(values, values[1:], strict=False))
        ]
    return values[0]


def _critical(
    routine: Routine, law: str, points: int, periods: int, steps: int
) -> tuple[Sliders, dict[str, float], float]:
    """All periods at the critical stiffness: the motion has to come back to its start."""
    sliders = Sliders(routine, law, np.full(points, CRITICAL), np.full(points, VELOCITY))
    level = float(excess(math.log(VELOCITY), 0.0))
    cycle, errors = period(level), {"drift": 0.0}
    for _ in range(periods):
        for _ in range(steps):
            sliders.step(cycle / steps)
        drift = np.abs(excess(*sliders.phase()) / level - 1.0).max()
        errors["drift"] = float(np.maximum(errors["drift"], drift))
        if not errors["drift"] < 1.0:  # this is no cycle
            break
    v, f = sliders.phase()
    errors["return"] = float(np.hypot(v - math.log(VELOCITY), f).max() / math.log(VELOCITY))
    return sliders, errors, cycle / steps


def _near(
    routine: Routine, law: str, points: int, steps: int
) -> tuple[Sliders, dict[str, float], float]:
    """Small disturbances of both signs beside the critical stiffness: their growth in a cycle.

    Half the difference of both has no part of second order.
    """
    errors, length = {}, 0.0
    for ratio in STIFFNESSES:
        sign = np.where(np.arange(2 * points) < points, 1.0, -1.0)
        velocity = np.exp(_SMALL * sign)
        sliders = Sliders(routine, law, np.full(2 * points, ratio * CRITICAL), velocity)
        growth, frequency = linear(ratio)
        cycle = 2.0 * math.pi / frequency
        for _ in range(steps):
            sliders.step(cycle / steps)
        v, f = (0.5 * (x[:points] - x[points:]) for x in sliders.phase())
        exact = _SMALL * math.exp(growth * cycle)
        errors[f"at {ratio:g} of the stiffness"] = float(np.hypot(v - exact, f).max() / exact)
        length = max(length, cycle / steps)
    return sliders, errors, length


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 4,
    periods: int = PERIODS,
    steps: int = _STEPS,
) -> Outcome:
    """One run against first integral, quadrature and linear theory."""
    with np.errstate(all="ignore"):  # a slider that nothing holds runs away
        if method == "critical":
            sliders, errors, step = _critical(routine, law, points, periods, steps)
        else:
            sliders, errors, step = _near(routine, law, points, steps)
    return Outcome(
        problem="P17", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=step, points=points,
        error=float(np.max(list(errors.values()))),
        error_of=f"drift in {periods} periods" if method == "critical" else "growth in a cycle",
        tolerance=_TOLERANCES[method], details=errors, **sliders.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P17",
    title="Slider on a spring of the critical stiffness, rate and state friction",
    statement="Sliders are pulled by springs at a constant velocity; ageing law, no inertia. At "
    "the stiffness p (b - a)/Dc they go round in a closed cycle for ever; with a stiffer spring "
    "a small disturbance fades, with a softer one it grows without bound.",
    laws=("rate_state_ageing",),
    methods=dict.fromkeys(("fric", "fric_coef"), ("critical", "near critical")),
    runner=run,
    options={
        "points": "sliders",
        "periods": "cycles at the critical stiffness",
        "steps": "steps in a cycle, each of ten increments",
    },
)
