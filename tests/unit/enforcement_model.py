# SPDX-License-Identifier: MIT
"""The enforcement of a coefficient in sixty digits, for the tests of penalty.c and lagrange.c.

Laws are plain formulas that run on floats and on mpmath numbers alike; tangents are compared with
differences taken in sixty digits, so that only the code under test has rounding.
"""

from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass, field

import mpmath
import pytest

from usersub.statuses import STATUSES

mpf = mpmath.mpf
CODE = {status.name: status.value for status in STATUSES}
real2, real6 = ctypes.c_double * 2, ctypes.c_double * 6


class Value(ctypes.Structure):
    _fields_ = [("mu", real2), ("d_mu", (ctypes.c_double * 8) * 2)]


class Input(ctypes.Structure):
    _fields_ = [
        ("directions", ctypes.c_int32),
        ("anisotropic", ctypes.c_int32),
        *(
            (name, ctypes.c_double)
            for name in (
                "pressure",
                "time_increment",
                "critical",
                "slope",
                "limit",
            )
        ),
        *((name, ctypes.c_void_p) for name in ("elastic_slip", "slip", "slip_increment")),
        ("equivalent_slip", ctypes.c_double),
    ]


class Output(ctypes.Structure):
    _fields_ = [
        ("tau", real2),
        ("elastic_slip", real2),
        ("plastic", real2),
        ("equivalent", ctypes.c_double),
        ("by_gamma", real2 * 2),
        ("by_pressure", real2),
        ("by_temperature", real2),
        ("sed", ctypes.c_double),
        ("sfd", ctypes.c_double),
        ("sticks", ctypes.c_int32),
        ("mu", real2),
        ("mu_by_pressure", real2),
    ]


FRICTION = ctypes.CFUNCTYPE(
    ctypes.c_int32, ctypes.c_void_p, ctypes.POINTER(ctypes.c_double), ctypes.POINTER(Value)
)


@dataclass(frozen=True)
class Law:
    """mu_k = level_k exp(-x) or level_k / (1 + x^2), where x = weights_k . (rate, pressure,
    temperature, rate 1, rate 2, equivalent slip, slip 1, slip 2)."""

    levels: tuple[float, ...]
    weights: tuple[tuple[float, ...], ...] = ((0.0,) * 8, (0.0,) * 8)
    rational: bool = False

    def mu(self, variables):
        """Coefficients and their eight derivatives, in the arithmetic of the variables."""
        exact = isinstance(variables[0], mpf)
        exp = mpmath.exp if exact else math.exp
        values, slopes = [], []
        for level, weights in zip(self.levels, self.weights, strict=False):
            level, weights = (mpf(level) if exact else level), weights
            x = sum(w * v for w, v in zip(weights, variables, strict=True))
            mu = level / (1 + x * x) if self.rational else level * exp(-x)
            slope = -2 * x * mu / (1 + x * x) if self.rational else -mu
            values.append(mu)
            slopes.append([w * slope for w in weights])
        return values, slopes


@dataclass(frozen=True)
class Case:
    """One point at the start of an increment."""

    law: Law
    slip_increment: tuple[float, ...]
    elastic_slip: tuple[float, ...] = (0.0, 0.0)
    slip: tuple[float, ...] = (0.0, 0.0)
    equivalent_slip: float = 0.0
    pressure: float = 1.0
    temperature: float = 0.0
    time_increment: float = 1.0
    critical: float = 1.0
    slope: float = 0.0
    limit: float = 0.0
    anisotropic: bool = False
    directions: int = 2
    calls: list = field(default_factory=list, compare=False)


def update(library, case: Case, *, tangent: bool = True, friction=None, lagrange=None):
    """Status and output of the code under test: of usub_penalty_update, or, with `lagrange`, a pair
    of whether the point was stuck and its stress, of usub_lagrange_update."""

    def answer(_context, data, value):
        data = list(data[:6])
        case.calls.append(data)
        variables = (data[0], case.pressure, case.temperature, data[1], data[2], *data[3:6])
        mu, slopes = case.law.mu(variables)
        for k, coefficient in enumerate(mu):
            value[0].mu[k] = coefficient
            value[0].d_mu[k][:] = slopes[k]
        return 0

    vectors = [real2(*x) for x in (case.elastic_slip, case.slip, case.slip_increment)]
    given = Input(
        case.directions, case.anisotropic, case.pressure, case.time_increment, case.critical,
        case.slope, case.limit, *(ctypes.cast(v, ctypes.c_void_p) for v in vectors),
        case.equivalent_slip,
    )  # fmt: skip
    output, friction = Output(), FRICTION(friction or answer)
    rest = (friction, None, int(tangent), ctypes.byref(output))
    if lagrange is None:
        return library.usub_penalty_update(ctypes.byref(given), *rest), output
    stuck, stress = lagrange
    return library.usub_lagrange_update(
        ctypes.byref(given), int(stuck), real2(*stress), *rest
    ), output


def return_mapping(case: Case, *, gamma=(0, 0), pressure=0, temperature=0, sticks=None):
    """The model of penalty.h in mpmath, with the inputs moved by the keywords.

    Returns stress, elastic slip, plastic slip, whether it sticks. `sticks` fixes the branch.
    """
    number = case.directions
    g = [mpf(case.elastic_slip[i]) + mpf(case.slip_increment[i]) + gamma[i] for i in range(number)]
    p, theta = mpf(case.pressure) + pressure, mpf(case.temperature) + temperature
    dt = mpf(case.time_increment)

    def strength_of(mean):
        strength = mean * p if p > 0 else mpf(0)
        return mpf(case.limit) if case.limit and strength > case.limit else strength

    def coefficients(plastic):
        length = mpmath.sqrt(sum(x * x for x in plastic))
        rates = [x / dt if dt else mpf(0) for x in plastic] + [mpf(0)]
        slips = [mpf(case.slip[i]) + plastic[i] for i in range(number)] + [mpf(0)]
        rate = length / dt if dt else mpf(0)
        mu, _ = case.law.mu(
            (rate, p, theta, *rates[:2], mpf(case.equivalent_slip) + length, *slips[:2])
        )
        if number == 1 or not case.anisotropic:
            return mu[0], [mpf(1)] * number
        mean = sum(mu) / 2
        return mean, [m / mean if mean else mpf(1) for m in mu]

    plastic, before = [mpf(0)] * number, None
    for _ in range(400):
        mean, a = coefficients(plastic)
        strength = strength_of(mean)
        c = strength / mpf(case.slope) if case.slope else mpf(case.critical)
        scaled = [a[i] * g[i] for i in range(number)]
        size = mpmath.sqrt(sum(x * x for x in scaled))
        stick = size <= c if sticks is None else sticks
        plastic = [mpf(0) if stick else (1 - c / size) * x for x in g]
        if before is not None and all(
            abs(x - y) <= abs(x) * mpf(10) ** -56 for x, y in zip(plastic, before, strict=True)
        ):
            break
        before = plastic
    else:
        pytest.fail("the reference iteration does not converge: choose a milder law")
    stiffness = mpf(case.slope) if stick and case.slope else strength / (c if stick else size)
    tau = [a[i] * stiffness * scaled[i] for i in range(number)]
    return tau, [x - y for x, y in zip(g, plastic, strict=True)], plastic, stick


def close(value, expected, relative, floor):
    assert abs(mpf(value) - expected) <= relative * abs(expected) + floor, (value, expected)


def check_state(case: Case, output: Output, relative=1e-13):
    """Rounding of the code under test only: some ten operations, and |g~| - c, which cancels."""
    tau, elastic, plastic, stick = return_mapping(case)
    number = case.directions
    size = max(abs(e) + abs(g) for e, g in zip(elastic, plastic, strict=True))
    assert bool(output.sticks) == stick
    for i in range(number):
        close(output.tau[i], tau[i], relative, relative * 1e-3 * max(map(abs, tau)))
        close(output.elastic_slip[i], elastic[i], relative, 0)
        close(output.plastic[i], plastic[i], relative, 1e-15 * size)
    length = mpmath.sqrt(sum(x * x for x in plastic))
    close(output.equivalent, length, relative, 1e-15 * size)
    sed = sum(t * e for t, e in zip(tau, elastic, strict=True)) / 2
    sfd = sum(t * e for t, e in zip(tau, plastic, strict=True))
    close(output.sed, sed, relative, 0)
    close(output.sfd, sfd, relative, 1e-15 * size * max(map(abs, tau)))


def check_tangent(case: Case, output: Output, relative=1e-9, model=None):
    """Every derivative against a central difference of `model(gamma=, pressure=, temperature=)`."""
    if model is None:
        stick = return_mapping(case)[3]

        def model(**step):
            return return_mapping(case, sticks=stick, **step)[0]

    scale = max(abs(mpf(x)) for x in (*case.slip_increment, *case.elastic_slip, case.critical))
    steps = {
        "gamma 1": (scale, {"gamma": (1, 0)}),
        "gamma 2": (scale, {"gamma": (0, 1)}),
        "pressure": (abs(mpf(case.pressure)) or 1, {"pressure": 1}),
        "temperature": (abs(mpf(case.temperature)) or 1, {"temperature": 1}),
    }
    if case.directions == 1:
        del steps["gamma 2"]
    for name, (size, direction) in steps.items():
        h = size * mpf(10) ** -18
        moved = []
        for sign in (1, -1):
            step = {
                key: tuple(sign * h * x for x in value) if key == "gamma" else sign * h * value
                for key, value in direction.items()
            }
            moved.append(model(**step))
        column = [(up - down) / (2 * h) for up, down in zip(*moved, strict=True)]
        # Entries are sums: one that vanishes by cancellation is left with rounding of its summands,
        # which are of the size of the column, or of the stress over the variable.
        largest = max(map(abs, column))
        for i in range(case.directions):
            got = {
                "gamma 1": output.by_gamma[i][0],
                "gamma 2": output.by_gamma[i][1],
                "pressure": output.by_pressure[i],
                "temperature": output.by_temperature[i],
            }[name]
            close(got, column[i], relative, 1e-14 * largest + 1e-15 * abs(moved[0][i]) / size)


WEIGHTS = (
    (0.031, 0.0023, 0.00071, 0.017, -0.023, 0.041, 0.029, -0.037),
    (-0.019, 0.0011, 0.00053, -0.029, 0.031, 0.023, -0.041, 0.047),
)
BASE = Case(
    law=Law((0.31, 0.47), WEIGHTS),
    slip_increment=(1.7, -0.9),
    elastic_slip=(0.21, 0.13),
    slip=(3.1, -2.3),
    equivalent_slip=5.9,
    pressure=37.0,
    temperature=211.0,
    time_increment=0.43,
    critical=0.67,
)


def rigid_model(case: Case, stress=None, *, gamma=(0, 0), pressure=0, temperature=0):
    """Stress of a slip without elastic part, in mpmath: along the slip, or along `stress`."""
    number, dt = case.directions, mpf(case.time_increment)
    g = [mpf(case.slip_increment[i]) + gamma[i] for i in range(number)]
    p, theta = mpf(case.pressure) + pressure, mpf(case.temperature) + temperature
    length = mpmath.sqrt(sum(x * x for x in g))
    rates = [x / dt if dt else mpf(0) for x in (length, *g)] + [mpf(0)]
    slips = [mpf(case.slip[i]) + g[i] for i in range(number)] + [mpf(0)]
    mu, _ = case.law.mu(
        (rates[0], p, theta, *rates[1:3], mpf(case.equivalent_slip) + length, *slips[:2])
    )
    one = number == 1 or not case.anisotropic
    mean = mu[0] if one else sum(mu) / 2
    a = [mpf(1)] * number if one else [m / mean for m in mu]
    strength = mean * p if p > 0 else mpf(0)
    if case.limit and strength > case.limit:
        strength = mpf(case.limit)
    if stress is None:
        scaled = [a[i] * g[i] for i in range(number)]
    else:
        scaled = [mpf(stress[i]) / a[i] for i in range(number)]
    size = mpmath.sqrt(sum(x * x for x in scaled))
    return [a[i] * strength * scaled[i] / size for i in range(number)]
