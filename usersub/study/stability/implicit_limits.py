# SPDX-License-Identifier: MIT
"""Limits of implicit analyses: stiffness and Newton's method, critical stiffness, uniqueness."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from usersub.study.stability.cell import Limit

#: Displacements of the base, in ordinary slips: into slip, a bend, back, stick, on.
_PATH = ((0.5, 0.0), (2.0, 0.0), (2.5, 1.0), (1.0, 0.5), (1.0, 0.5), (0.9, 0.45), (-3.0, 2.0))
_MOST = 60

#: Enforcement whose stiffness is a setting: name, law, settings, the setting, by which exponent.
_STIFF: tuple[tuple[str, str, tuple[float, ...], dict[str, Any]], ...] = (
    ("slope, one direction", "coulomb", (0.3,), {"stick_slope": 1.0, "dimension": 2}),
    ("penalty, one direction", "coulomb", (0.3,), {"elastic_slip": 1.0, "dimension": 2}),
    ("slope, one direction, of the rate", "exponential_decay", (0.3, 0.2, 0.5),
     {"stick_slope": 1.0, "dimension": 2}),
    ("slope", "coulomb", (0.3,), {"stick_slope": 1.0}),
    ("slope, two coefficients", "anisotropic", (0.3, 0.15), {"stick_slope": 1.0, "anisotropic": 1}),
    ("slope, of the rate", "exponential_decay", (0.3, 0.2, 0.5), {"stick_slope": 1.0}),
    ("penalty", "coulomb", (0.3,), {"elastic_slip": 1.0}),
    ("penalty, two coefficients", "anisotropic", (0.3, 0.15),
     {"elastic_slip": 1.0, "anisotropic": 1}),
    ("penalty, of the rate", "exponential_decay", (0.3, 0.2, 0.5), {"elastic_slip": 1.0}),
)  # fmt: skip


def newton_iterations(
    law: str, props: tuple[float, ...], settings: dict[str, Any], interface: str = "fric_coef"
) -> int:
    """Most iterations of an increment of a point on a unit spring.

    The base moves along a path and draws the point by the spring; the strength is 0.3. Plain Newton
    with the driver's tangent, without line search; `_MOST` where it does not converge.
    """
    from usersub import Scene, StandardDriver, laws

    routine = laws.routine(law, interface, "c")
    two = settings.get("dimension", 3) - 1
    scene = Scene(points=1, props=props, **settings)
    driver = StandardDriver(routine, scene, reuse=True)
    motion, place, most = np.zeros((two, 1), order="F"), np.zeros(two), 0
    driver.bind(slip_increment=motion, pressure=np.ones(1))
    for base in _PATH:
        driver.begin_increment(1.0)
        step, tau = np.zeros(two), np.zeros(two)
        for count in range(1, _MOST + 1):  # noqa: B007 - read after the loop
            motion[:, 0] = step
            response = driver.iterate()
            tau = response.tau[:, 0].copy()
            residual = np.array(base)[:two] - (place + step) - tau
            matrix = np.eye(two) + response.ddtddg[:, :, 0]  # type: ignore[index]
            if not np.linalg.cond(matrix) < 1e16:  # the host's stiffness is lost in rounding
                return _MOST
            change = np.linalg.solve(matrix, residual)
            if np.max(np.abs(residual)) < 1e-11 and np.max(np.abs(change)) < 1e-11:
                break
            step = step + change
        most = max(most, count)
        driver.commit()
        place = place + step
    return most


def stiff_newton(quick: bool) -> Iterator[Limit]:
    """Stiffness in stick from 1 to 1e18 times that of the host."""
    ratios = [1.0, 1e3, 1e9, 1e16, 1e18] if quick else [10.0**k for k in range(19)]
    for name, law, props, settings in _STIFF:
        counts = {}
        for ratio in ratios:
            if "stick_slope" in settings:
                stiff = {**settings, "stick_slope": ratio}
            else:
                stiff = {**settings, "elastic_slip": 0.3 / ratio}
            counts[ratio] = newton_iterations(law, props, stiff)
        good = [ratio for ratio, count in counts.items() if count < _MOST]
        through = [r for r in ratios if all(q in good for q in ratios if q <= r)]
        words = "1 to 1e18 were tried: all up to it converge to 1e-11"
        if max(through, default=0.0) < 1e18:
            words += "; beyond 1/eps the matrix of two directions has lost the host's stiffness"
        yield Limit(
            "largest stiffness ratio", f"driver: {name}", "fric_coef", "c", "double",
            max(through, default=0.0), None, "of the host's stiffness", words,
        )  # fmt: skip
        # Stick and slip are straight lines: a step on the wrong one, one on the right one, a look.
        straight = law == "coulomb" and settings.get("dimension") == 2
        theory = 3.0 if straight else None
        piecewise = "; theory: two straight lines, and a look" if straight else ""
        yield Limit(
            "Newton iterations at most", f"driver: {name}", "fric_coef", "c", "double",
            float(max(counts[r] for r in through)), theory, "-",
            f"over those stiffness ratios, path of {len(_PATH)} increments with reversals"
            + piecewise,
        )  # fmt: skip


def ellipse_newton(quick: bool) -> Iterator[Limit]:
    """Two coefficients up to 1e8 times apart."""
    ratios = [1.0, 1e4, 1e8] if quick else [10.0**k for k in range(9)]
    for name, settings in (("slope", {"stick_slope": 1e3}), ("penalty", {"elastic_slip": 3e-4})):
        counts = {
            r: newton_iterations("anisotropic", (0.3, 0.3 / r), {**settings, "anisotropic": 1})
            for r in ratios
        }
        good = [r for r, c in counts.items() if c < _MOST]
        yield Limit(
            "largest ratio of an ellipse", f"driver: {name}, two coefficients", "fric_coef", "c",
            "double", max(good, default=0.0), None, "-", "1 to 1e8 were tried; "
            f"most iterations {max(counts.values())}",
        )  # fmt: skip


def critical_stiffness(quick: bool) -> Iterator[Limit]:
    """P17: where a small disturbance neither grows nor fades."""
    from usersub import laws
    from usersub.problems import p17

    steps = 16 if quick else 32
    for interface in ("fric", "fric_coef"):
        routine = laws.routine("rate_state_ageing", interface, "c")
        ratios = np.array([0.97, 1.03])
        growth = np.array([_growth(p17, routine, r, steps) for r in ratios])
        found = ratios[0] - growth[0] * (ratios[1] - ratios[0]) / (growth[1] - growth[0])
        theory = p17.PRESSURE * p17.CRITICAL
        yield Limit(
            "critical stiffness (P17)", "rate_state_ageing", interface, "c", "double",
            float(found * theory), theory, "stress/length",
            "stiffness at which a disturbance keeps its size in a cycle; theory p (b - a)/Dc",
        )  # fmt: skip


def _growth(p17: Any, routine: Any, ratio: float, steps: int) -> float:
    """Logarithm of the growth in one cycle."""
    small = 1e-4
    velocity = np.exp(small * np.array([1.0, -1.0]))
    sliders = p17.Sliders(routine, "rate_state_ageing", np.full(2, ratio * p17.CRITICAL), velocity)
    cycle = 2.0 * math.pi / p17.linear(ratio)[1]
    for _ in range(steps):
        sliders.step(cycle / steps)
    v, f = (0.5 * (x[0] - x[1]) for x in sliders.phase())
    return math.log(math.hypot(v, f) / small)


def of_problems() -> Iterator[Limit]:
    """P20, P21, P22: no solution or two, uniqueness, flutter; what a symmetric tangent misses."""
    from usersub import laws
    from usersub.problems import p20, p21, p22

    for module, what, name, theory, unit in (
        (p20, "least coefficient", "least coefficient without a solution (P20)", 4.0 / 3.0, "-"),
        (p21, "limit", "coupling mu |W|/K_t at which uniqueness ends (P21)", 1.0, "-"),
        (p22, "limit", "coupling at which flutter begins (P22)", 1.0, "of the exact one"),
    ):
        law, interface = module.PROBLEM.laws[0], next(iter(module.PROBLEM.methods))
        method = module.PROBLEM.methods[interface][0]
        outcome = module.PROBLEM.runner(laws.routine(law, interface, "c"), law, "double", method)
        error = float(outcome.details[what])
        yield Limit(
            name, law, interface, "c", "double", theory * (1.0 + error), theory, unit,
            f"largest deviation {error:.1e}. {outcome.says}",
        )  # fmt: skip


def all_of(quick: bool) -> Iterator[Limit]:
    """All limits of implicit analyses."""
    yield from stiff_newton(quick)
    yield from ellipse_newton(quick)
    yield from critical_stiffness(quick)
    yield from of_problems()
