# SPDX-License-Identifier: MIT
"""Exponential decay from two or three measured points."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import log, mpf, workdps

import usersub
from usersub import laws
from usersub.errors import SceneError
from usersub.laws.decay_data import decay

COEFFICIENTS = st.floats(1e-6, 10.0)


def test_three_points():
    law = laws.exponential_decay_from_test_data(0.5, 0.3, 100.0, 0.1)
    assert law == laws.exponential_decay(mus=0.5, muk=0.1, dc=math.log(2.0) / 100.0)


def test_two_points_leave_a_twentieth():
    law = laws.exponential_decay_from_test_data(mu1=0.5, mu2=0.31, rate2=100.0)
    assert law.values["mus"] == 0.5
    assert law.values["muk"] == pytest.approx(0.3, rel=1e-15)
    assert law.values["dc"] == math.log(20.0) / 100.0


@given(COEFFICIENTS, COEFFICIENTS, st.floats(1e-6, 1e6), st.none() | COEFFICIENTS)
def test_results_are_exact(mu1, mu2, rate2, mu_inf):
    """Each number is the exact one, rounded; the decay coefficient to two units."""
    try:
        mus, muk, dc = decay(mu1, mu2, rate2, mu_inf)
    except SceneError:
        return
    share = Fraction(1, 20)
    exact = (Fraction(mu2) - share * Fraction(mu1)) / (1 - share)
    limit = Fraction(mu_inf) if mu_inf is not None else exact
    assert (mus, muk) == (mu1, float(limit))
    with workdps(60):
        left = (Fraction(mu1) - limit) / (Fraction(mu2) - limit)
        wanted = log(mpf(left.numerator) / left.denominator) / mpf(rate2)
        assert abs(mpf(dc) - wanted) <= 2 * mpf(math.ulp(dc))


@given(COEFFICIENTS, COEFFICIENTS, st.floats(1e-3, 1e3), COEFFICIENTS)
def test_the_law_goes_through_the_points(mu1, mu2, rate2, mu_inf):
    try:
        mus, muk, dc = decay(mu1, mu2, rate2, mu_inf)
    except SceneError:
        return
    at = muk + (mus - muk) * math.exp(-dc * rate2)
    # The exponent has a rounding error relative to itself.
    assert at == pytest.approx(mu2, rel=1e-14, abs=1e-14 * max(mu1, mu_inf))


@pytest.mark.parametrize(
    ("points", "told"),
    [
        ((0.3, 0.2, 0.0), "slip rate of the second point is 0, expected more than 0"),
        ((0.3, 0.2, -1.0), "expected more than 0"),
        ((0.3, -0.2, 1.0), "a friction coefficient is negative"),
        ((0.3, 0.2, 1.0, -0.1), "a friction coefficient is negative"),
        ((0.3, 0.3, 1.0), "nothing decays; give a constant coefficient"),
        ((0.3, 0.001, 1.0), "would be -0.0147368, below 0"),
        ((0.3, 0.1, 1.0, 0.2), "0.1 is not between the static one 0.3 and the kinetic one 0.2"),
        ((0.3, 0.2, 1.0, 0.2), "is not between"),
        ((0.3, 0.2, 1e-320, 0.1), "decay coefficient would be inf"),
        ((math.nan, 0.2, 1.0), "mu1 is nan, expected a finite number"),
        ((0.3, 0.2, math.inf), "rate2 is inf"),
    ],
)
def test_impossible_data_are_refused(points, told):
    with pytest.raises(SceneError, match=told):
        laws.exponential_decay_from_test_data(*points)


def test_the_deck_reads_the_same():
    deck = usersub.deck.decay_from_test_data(0.5, 0.3, 100.0, 0.1)
    law = laws.exponential_decay_from_test_data(0.5, 0.3, 100.0, 0.1)
    assert (deck.mus, deck.muk, deck.dc) == law.props
