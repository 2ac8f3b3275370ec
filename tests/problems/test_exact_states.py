# SPDX-License-Identifier: MIT
"""Exact answers of the problems P13 to P18 against arbitrary precision, and published numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpf, workdps

from usersub import problems
from usersub.problems import p13, p14, p15, p16, p17, p18


@pytest.fixture(autouse=True)
def _digits():
    with workdps(40):
        yield


def test_loop_of_a_bristle():
    # F' = sigma (1 - F/Fc) forth, its mirror image back: F(X) from -F_m at -X.
    sigma, limit, reach = mpf(1000), mpf(2), mpf("0.003")
    share = mp.exp(-2 * reach * sigma / limit)
    tip = mp.findroot(lambda f: limit - (limit + f) * share - f, mpf("1.8"))

    def forth(x):
        return limit - (limit + tip) * mp.exp(-(x + reach) * sigma / limit)

    work = 2 * mp.quad(forth, [-reach, reach])
    found = p13.loop(2.0)
    assert found[0] == pytest.approx(float(tip), rel=1e-15)
    assert found[1] == pytest.approx(float(work), rel=1e-14)
    assert found == pytest.approx((1.8102965073, 9.517627942e-3), rel=1e-9)  # as published


def test_slip_of_the_elasto_plastic_bristle():
    def slack(z):
        alpha = (1 + mp.sin(mp.pi * (z - mpf("0.85")) / mpf("0.3"))) / 2
        return 1 - alpha * z

    for bend in (0.75, 0.9, 0.99):
        exact = mp.quad(lambda z: 1 / slack(z), mp.linspace(mpf("0.7"), mpf(bend), 5))
        assert p13.bend_length(bend) == pytest.approx(float(exact), rel=1e-13)


def _elements(places):
    """The elements one by one, in exact fractions of their motion."""
    spring = np.zeros(5)
    limit = p14.MU * problems.path_host.PRESSURE * p14.SHARE
    found, here = [], 0.0
    for place in places:
        spring = np.clip(spring + p14.STIFFNESS * (place - here), -limit, limit)
        here = place
        found.append(spring.sum())
    return found


@pytest.mark.parametrize("increments", [1, 3, 50])
def test_rules_of_masing_and_of_memory(increments):
    # The rules know nothing of elements; both ways to the same path have to agree to rounding.
    places = p14._places(increments)
    assert p14.path_traction(places) == pytest.approx(_elements(places), abs=1e-15)


def test_memory_of_random_turning_points():
    rng = np.random.default_rng(20240307)
    for _ in range(50):
        places = list(rng.uniform(-2e-3, 2e-3, 30))
        assert p14.path_traction(places) == pytest.approx(_elements(places), abs=1e-14)


def test_velocity_step():
    a, b, old, new = mpf(p15.A), mpf(p15.B), mpf(2), mpf(2) / 10
    for slip in (mpf("0.1"), mpf(2)):
        decay = mp.exp(-slip / 2)
        theta = {
            "rate_state_ageing": new + (old - new) * decay,
            "rate_state_slip": mp.exp(mp.log(new) + mp.log(old / new) * decay),
        }
        for law, state in theta.items():
            mu = mpf(p15.MU) + a * mp.log(10) + b * mp.log(state / 2)
            assert p15.coefficient(law, float(slip)) == pytest.approx(float(mu), rel=1e-15)
        state = theta["rate_state_ageing"]
        mu = a * mp.asinh(5 * mp.exp((mpf(p15.MU) + b * mp.log(state / 2)) / a))
        found = p15.coefficient("rate_state_regularised", float(slip))
        assert found == pytest.approx(float(mu), rel=1e-15)
    # As published: the new steady state.
    assert p15.coefficient("rate_state_ageing", 200.0) == pytest.approx(0.588487075, rel=1e-9)
    assert mpf("0.6") + (a - b) * mp.log(10) == pytest.approx(0.588487075, rel=1e-9)


def test_growth_at_rest():
    for hold, _ in p16.HOLDS:
        exact = mpf("0.01") * mp.log(1 + mpf(hold) / 1000)
        assert p16.growth(hold) == pytest.approx(float(exact), rel=1e-14)


def _rates(v, f, k):
    """Derivatives of ln V and ln theta by time."""
    a, b = mpf(p17.A), mpf(p17.B)
    return (k * (1 - mp.exp(v)) - b * (mp.exp(-f) - mp.exp(v))) / a, mp.exp(-f) - mp.exp(v)


def test_first_integral_of_the_critical_slider():
    k = mpf(p17.B) - mpf(p17.A)
    for v, f in ((mpf("0.7"), mpf("-0.3")), (mpf(-1), mpf("0.4"))):
        v_rate, f_rate = _rates(v, f, k)

        def level(v, f):
            return mpf(p17.A) * (mp.exp(v + f) - v - f) + k * (mp.exp(f) - f)

        change = mp.diff(level, (v, f), (1, 0)) * v_rate + mp.diff(level, (v, f), (0, 1)) * f_rate
        assert abs(change) < mpf(10) ** -15
        least = p17.A + p17.CRITICAL
        assert p17.excess(float(v), float(f)) == pytest.approx(
            float(level(v, f)) - least, rel=1e-12
        )


def test_period_of_the_critical_slider():
    # Small cycles: the linear one. Large ones: thousands of Runge-Kutta's steps.
    assert p17.period(1e-12) == pytest.approx(2.0 * math.pi / math.sqrt(0.5), rel=1e-6)
    v, f, time, dt = math.log(1.5), 0.0, 0.0, 1e-3

    def rates(v, f):
        return (
            (p17.CRITICAL * (1 - math.exp(v)) - p17.B * (math.exp(-f) - math.exp(v))) / p17.A,
            math.exp(-f) - math.exp(v),
        )

    while True:
        k1 = rates(v, f)
        k2 = rates(v + 0.5 * dt * k1[0], f + 0.5 * dt * k1[1])
        k3 = rates(v + 0.5 * dt * k2[0], f + 0.5 * dt * k2[1])
        k4 = rates(v + dt * k3[0], f + dt * k3[1])
        last = f
        v += dt * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]) / 6
        f += dt * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]) / 6
        time += dt
        if last > 0.0 >= f and v > 0.0:
            break
    cycle = time - f / rates(v, f)[1]  # the end of the last step
    level = float(p17.excess(math.log(1.5), 0.0))
    assert p17.period(level) == pytest.approx(cycle, rel=1e-7)


def test_growth_beside_the_critical_stiffness():
    for ratio in p17.STIFFNESSES:
        k = mpf(ratio) * (mpf(p17.B) - mpf(p17.A))
        matrix = mp.matrix(2)
        for row in (0, 1):
            for column in (0, 1):
                order = (int(column == 0), int(column == 1))
                matrix[row, column] = mp.diff(
                    lambda v, f, row=row, k=k: _rates(v, f, k)[row], (0, 0), order
                )
        value = mp.eig(matrix)[0][0]
        growth, frequency = p17.linear(ratio)
        assert growth == pytest.approx(float(mp.re(value)), rel=1e-10)
        assert frequency == pytest.approx(abs(float(mp.im(value))), rel=1e-10)
        assert (growth > 0.0) == (ratio < 1.0)
    # As published: the frequency at the critical stiffness.
    assert p17.linear(1.0)[1] == pytest.approx(math.sqrt((p17.B - p17.A) / p17.A), rel=1e-14)


def test_energy_of_slip_weakening():
    drop = (mpf("0.677") - mpf("0.525")) * 120_000_000
    assert p18.STATIC * p18.PRESSURE == pytest.approx(81.24e6, rel=1e-14)
    assert p18.DYNAMIC * p18.PRESSURE == pytest.approx(63.0e6, rel=1e-14)
    linear = mp.quad(lambda s: drop * (1 - s / mpf("0.4")), [0, mpf("0.4")])
    assert p18.energy("slip_weakening") == pytest.approx(float(linear), rel=1e-14)
    assert p18.energy("slip_weakening") == pytest.approx(3.648e6, rel=1e-12)
    decay = mp.quad(lambda s: drop * mp.exp(-s / mpf("0.4")), [0, 1, 4, 16])
    assert p18.energy("slip_weakening_exponential") == pytest.approx(float(decay), rel=1e-14)


@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_symmetric_increments_are_of_high_order(interface):
    outcomes = [
        problems.run("P17", interface=interface, language="c", periods=2, steps=steps)
        for steps in (8, 16)
    ]
    errors = [o.details["drift"] for o in outcomes]
    # Order 8, where the extrapolated terms are not yet all.
    assert math.log2(errors[0] / errors[1]) > 6.0


def test_bristle_needs_no_small_increments():
    outcome = problems.run("P13", interface="fric", language="c", law="dahl", method="start")
    assert outcome.error < 1e-14
