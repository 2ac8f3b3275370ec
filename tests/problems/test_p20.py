# SPDX-License-Identifier: MIT
"""P20: Painleve's rod against Newton and Euler's equations, and its answers in words."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf, workdps
from scipy.integrate import solve_ivp

from usersub import problems
from usersub.problems import p20


@pytest.fixture(autouse=True)
def _digits():
    with workdps(30):
        yield


def _lifting(mu, phi, force, spin):
    """Normal acceleration of the end by g from the rod's own equations; unit mass, length 2."""
    # The centre is at (cos, sin) of the end, which slides to -x: friction pulls to +x.
    friction, inertia = mu * force, mpf(1) / 3
    upward = force - 1
    turning = (-mp.cos(phi) * force + mp.sin(phi) * friction) / inertia
    rate2 = spin / mp.sin(phi)
    # y of the end is that of the centre less sin(phi).
    return upward - mp.cos(phi) * turning + mp.sin(phi) * rate2


@pytest.mark.parametrize("spin", [0.0, 0.35, 1.6])
def test_closed_form_is_that_of_the_rigid_body(spin):
    for mu in (mpf("0.3"), mpf("1.37"), mpf("2.5")):
        for tangent in (mpf("0.4"), mpf(2), mpf(7)):
            phi = mp.atan(tangent)
            zero = _lifting(mu, phi, mpf(0), spin)
            slope = _lifting(mu, phi, mpf(1), spin) - zero
            found = p20.lift(float(mu), np.array([float(tangent)]))[0]
            assert found == pytest.approx(float(slope), rel=1e-13)
            assert p20.free(float(tangent), spin) == pytest.approx(float(zero), rel=1e-13)
            assert (slope < 0) == (mu > p20.critical(tangent))
            # All complementary pairs: no force and lifting off, or a force that holds.
            count = int(zero > 0) + int(-zero / slope > 0)
            found = p20.solutions(float(mu), np.array([float(tangent)]), np.array([spin]))
            assert found[0] == count
            paradox = mu > p20.critical(tangent)
            assert count == ((2 if zero > 0 else 0) if paradox else 1)


def test_least_coefficient():
    angle = mp.findroot(lambda t: mp.diff(p20.critical, t), mpf("1.8"))
    assert angle == pytest.approx(2.0, rel=1e-12)
    assert p20.critical(angle) == pytest.approx(4.0 / 3.0, rel=1e-14)  # as published
    assert p20.bad_angles(1.3) is None
    for end in p20.bad_angles(1.8):
        assert p20.critical(end) == pytest.approx(1.8, rel=1e-14)
        # The same, as published.
        sine, cosine = end / np.hypot(1.0, end), 1.0 / np.hypot(1.0, end)
        assert (1.0 + 3.0 * cosine**2) / (3.0 * sine * cosine) == pytest.approx(1.8, rel=1e-14)


@pytest.mark.parametrize("interface", p20.PROBLEM.interfaces)
def test_answer_is_in_words(interface):
    outcome = problems.run("P20", interface=interface, language="c")
    assert outcome.ok, outcome
    small, below, just, *_, last = outcome.says.split("; ")
    for words in (small, below):
        assert words.endswith(": one solution everywhere")
    assert just == (
        "mu 1.37: no solution (pressed on) or two solutions (leaving) at tan phi 1.7 to 2.4, "
        "one solution elsewhere"
    )
    assert last == "least mu without a motion 1.3333 at tan phi = 2"
    assert outcome.details["wrong counts"] == 0.0


@pytest.mark.parametrize("interface", ["fric", "fric_coef", "vfric", "vfric_coef"])
def test_compliant_floor(interface):
    errors = []
    for steps in (200, 400):
        outcome = problems.run(
            "P20", interface=interface, language="c", method="compliant", steps=steps
        )
        assert outcome.ok and "no solution" in outcome.says and "two solutions" in outcome.says
        errors.append(outcome.error)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.05)


def test_depth_in_the_floor_by_an_independent_integration():
    mu, tangent, k = p20.COMPLIANT, 2.2, 1e4
    b = p20.lift(mu, np.array([tangent]))[0]
    rate = np.sqrt(-b * k / p20.MASS)

    def motion(_, state):
        force = k * state[0]
        acceleration = b * force / p20.MASS + p20.GRAVITY * (0.35 - 1.0)
        return [state[1], -acceleration]

    found = solve_ivp(motion, (0.0, 5.0 / rate), [0.0, 0.0], rtol=1e-11, atol=1e-16).y[0, -1]
    rest = p20.GRAVITY * 0.65 / (b * k / p20.MASS)
    assert found == pytest.approx(rest * (1.0 - np.cosh(5.0)), rel=1e-8)
    assert found > 0.0


def test_coefficient_that_is_too_small_is_seen(monkeypatch):
    whole = p20.make_points

    def less(routine, props, *rest):
        return whole(routine, [0.99 * props[0]], *rest)

    monkeypatch.setattr(p20, "make_points", less)
    outcome = problems.run("P20", interface="fric", language="c")
    assert not outcome.ok
    assert outcome.details["least coefficient"] == pytest.approx(1.0 / 0.99 - 1.0, rel=1e-6)
