# SPDX-License-Identifier: MIT
"""Coefficients at random points, within the accuracy that the laws state.

The points of `reference.py` show the cases that matter; these show that they were not chosen.
"""

from __future__ import annotations

import math
from decimal import Decimal
from types import SimpleNamespace

import law_cases
import numpy as np
import pytest
import reference
from mpmath import mpf, nstr, workdps

import usersub
from usersub import laws

POINTS, DRAWS = 60, 4


def _log(random, low: float, high: float) -> float:
    return math.exp(random.uniform(math.log(low), math.log(high)))


def _stribeck(random):
    static, vs = random.uniform(0.1, 0.9), _log(random, 1e-4, 10.0)
    props = [static, static * random.uniform(0.1, 1.0), vs, random.uniform(0.4, 2.5)]
    props.append(random.choice([0.0, 1e-3 / vs]))
    return props, lambda: {"slip_rate": vs * _log(random, 1e-3, 30.0)}


def _power_law(random):
    exponents = list(random.uniform(-1.5, 1.5, 3))
    props = [_log(random, 1e-3, 10.0), *exponents, 0.5, 1e-6, 1.0]
    return props, lambda: {
        "slip_rate": _log(random, 1e-8, 1e4), "pressure": _log(random, 1e-2, 1e9),
        "temperature": random.uniform(-10.0, 1500.0),
    }  # fmt: skip


def _wanheim_bay(random):
    k = _log(random, 0.1, 1e3)
    return [random.uniform(0.0, 1.0), k], lambda: {"pressure": k * _log(random, 0.5, 50.0)}


def _temperature_softening(random):
    cold, start, form = random.uniform(0.1, 0.9), random.uniform(-20.0, 80.0), random.choice([1, 2])
    width = _log(random, 50.0, 1500.0)
    hot = cold * random.uniform(0.05, 0.5)
    props = [form, cold, hot, start, start + width, random.uniform(0.3, 3.0)]
    return props, lambda: {"temperature": start + width * random.uniform(-0.1, 1.5)}


def _shear_limit(random):
    mu, limit = random.uniform(0.0, 1.0), _log(random, 1e-3, 1e4)
    return [mu, limit], lambda: {"pressure": limit * _log(random, 0.1, 1e3)}


def _tabulated(random):
    sizes = [int(n) for n in random.integers(1, 4, 4)]
    axes = [np.sort(random.uniform(0.0, 10.0 * 20.0**i, n)) for i, n in enumerate(sizes)]
    values = np.exp(random.uniform(math.log(1e-6), 0.0, math.prod(sizes)))
    props = [*sizes[:3], 1, sizes[3], *np.concatenate(axes), *values]
    return [float(p) for p in props], lambda: {
        "slip_rate": random.uniform(0.0, 12.0), "pressure": random.uniform(0.0, 240.0),
        "temperature": random.uniform(0.0, 4800.0), "fields": [random.uniform(0.0, 9e4)],
    }  # fmt: skip


DRAWN = {
    "stribeck": _stribeck,
    "power_law": _power_law,
    "wanheim_bay": _wanheim_bay,
    "temperature_softening": _temperature_softening,
    "shear_limit": _shear_limit,
    "coulomb_tabulated": _tabulated,
}


@pytest.mark.parametrize("law", DRAWN)
def test_scattered_points(law, language):
    random = np.random.default_rng(20260117)
    for _ in range(DRAWS):
        props, draw = DRAWN[law](random)
        points = [{**reference.POINT, **draw()} for _ in range(POINTS)]
        arrays = {n: np.array([p[n] for p in points]) for n in ("pressure", "temperature")}
        arrays["slip_data"] = np.zeros((6, POINTS), order="F")
        arrays["slip_data"][0] = [p["slip_rate"] for p in points]
        fields = len(points[0]["fields"])
        if fields:
            arrays["field"] = np.asfortranarray(np.array([p["fields"] for p in points]).T)
        scene = usersub.Scene(points=POINTS, props=props, temperatures=1, fields=fields)
        driver = usersub.CoefficientDriver(laws.routine(law, "fric_coef", language), scene)
        driver.evaluate(time_increment=0.25, **arrays)
        with workdps(reference.DIGITS):
            exact = [_exact(law, p, props) for p in points]
        key = (law, "fric_coef", "double", language)
        law_cases.assert_units(key, driver.array("coefficient"), exact)


def _exact(law: str, point: dict, props: list[float]) -> Decimal:
    q = {k: tuple(map(mpf, v)) if k in ("fields", "state") else mpf(v) for k, v in point.items()}
    value = reference.module(law).value(SimpleNamespace(**q), [mpf(p) for p in props])
    return Decimal(nstr(value, reference.WRITTEN))
