# SPDX-License-Identifier: MIT
"""Powers inside exponentials and products: exact to about a unit, derivatives, corners."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import exp, mpf, workdps

from usersub.lift import decay_of_power, drop_of_power, pairs, product_of_powers, stand_in
from usersub.lift.dual import Dual

RATES = st.floats(1e-6, 1e4)
EXPONENTS = st.floats(0.2, 4.0)


def units(found: float, exact) -> float:
    return float(abs(mpf(found) - exact) / mpf(math.ulp(float(exact))))


@given(RATES, st.floats(1e-4, 10.0), EXPONENTS)
def test_decay(x, end, exponent):
    with workdps(40):
        power = (mpf(x) / mpf(end)) ** mpf(exponent)
        found = decay_of_power(x, 0.0, end, exponent)
        if power < 20:
            assert units(found, exp(-power)) < 2
        elif power < 700:
            assert found == pytest.approx(float(exp(-power)), rel=1e-14)
        elif power > 750:
            assert found == 0.0


@given(st.floats(20.0, 1400.0), EXPONENTS)
def test_drop(x, exponent):
    with workdps(60):
        share = (mpf(x) - 20) / 1380
        exact = 1 - share ** mpf(exponent)
        found = drop_of_power(x, 20.0, 1400.0, exponent)
        assert units(found, exact) < 2 if exact > 0 else found == 0.0


@given(RATES, RATES, RATES, *[st.floats(-3.0, 3.0)] * 3, st.floats(0.1, 10.0))
def test_product(x, y, z, a, b, c, factor):
    with workdps(40):
        exact = mpf(factor) * mpf(x) ** mpf(a) * mpf(y) ** mpf(b) * mpf(z) ** mpf(c)
        assert units(product_of_powers(factor, x, a, y, b, z, c), exact) < 2


@pytest.mark.parametrize("function", [decay_of_power, drop_of_power])
@pytest.mark.parametrize("x", [3.5, 20.0, 60.0, 99.5])
def test_derivatives_by_all_but_the_exponent(function, x):
    form = {
        decay_of_power: lambda x, s, e: exp(-(((x - s) / (e - s)) ** mpf(1.7))),
        drop_of_power: lambda x, s, e: 1 - ((x - s) / (e - s)) ** mpf(1.7),
    }[function]
    numbers = (x, 2.0, 100.0)
    duals = [Dual(v, tuple(float(i == k) for k in range(3))) for i, v in enumerate(numbers)]
    found = stand_in.with_duals(function)(*duals, 1.7)
    assert found.value == function(*numbers, 1.7)
    with workdps(60):
        for k in range(3):
            moved = [mpf(v) + (mpf(10) ** -30) * (i == k) for i, v in enumerate(numbers)]
            slope = (form(*moved) - form(*map(mpf, numbers))) * mpf(10) ** 30
            assert found.partials[k] == pytest.approx(float(slope), rel=1e-12)


@pytest.mark.parametrize("function", [decay_of_power, drop_of_power])
def test_start(function):
    for exponent, slope in ((0.5, 0.0), (1.0, -0.25), (2.0, 0.0)):
        found = stand_in.with_duals(function)(Dual(3.0, (1.0,)), 3.0, 7.0, exponent)
        value, partials = getattr(found, "value", found), getattr(found, "partials", (0.0,))
        assert (value, partials) == (1.0, (slope,))
    assert function(2.5, 3.0, 7.0, 0.7) == 1.0


def test_corners_of_products():
    assert product_of_powers(0.0, 3.0, 2.0) == 0.0
    assert product_of_powers(2.0, 0.0, 0.5) == 0.0
    assert product_of_powers(2.0, 0.0, 0.0) == 2.0
    assert product_of_powers(1.0, 1e300, 2.0) == math.inf
    # neither factor is a number, the product is
    assert product_of_powers(1e-300, 1e300, 2.0, 1e-250, 1.2) == pytest.approx(1.0, rel=1e-12)
    assert product_of_powers(1.0, 5e-324, -1.0) == math.inf
    assert product_of_powers(3.0, 5e-324, 0.5) == pytest.approx(3 * math.sqrt(5e-324), rel=1e-15)


@given(*[st.floats(1e-30, 1e30)] * 4)
def test_pairs(a, b, c, d):
    with workdps(60):
        x, y = pairs.exact_sum(a, b), pairs.exact_product(c, d)
        assert mpf(x[0]) + x[1] == mpf(a) + b
        assert mpf(y[0]) + y[1] == mpf(c) * d
        exact = {
            pairs.add: mpf(a) + b + mpf(c) * d,
            pairs.less: mpf(a) + b - mpf(c) * d,
            pairs.times: (mpf(a) + b) * (mpf(c) * d),
            pairs.over: (mpf(a) + b) / (mpf(c) * d),
        }
        for function, value in exact.items():
            found = function(x, y)
            scale = abs(mpf(a) + b) + mpf(c) * d if function in (pairs.add, pairs.less) else value
            assert abs(mpf(found[0]) + found[1] - value) <= scale * mpf(2) ** -98
        found = pairs.sqrt(x)
        assert abs(mpf(found[0]) + found[1] - (mpf(a) + b) ** mpf("0.5")) <= mpf(found[0]) * 2**-98
