# SPDX-License-Identifier: MIT
"""P21: Klarbring's point: closed form against all states one by one; what DDTDDP is needed for."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from usersub import problems
from usersub.problems import p21
from usersub.problems.sliding_points import StandardPoints

RUNS = [("fric", "penalty"), ("fric_coef", "penalty"), ("fric_coef", "lagrange")]


def _states(along, coupling, load):
    """Every state that keeps all conditions, in fractions: stick, slip either way, lift-off."""
    mu, normal = Fraction(p21.MU), Fraction(p21.NORMAL)
    found = []
    if abs(load) <= mu * normal:
        found.append(("stick", Fraction(0)))
    for side in (1, -1):
        # K_t u + side mu p = f_t with p = f_n - W u
        slope = along - side * mu * coupling
        u = (load - side * mu * normal) / slope
        if side * u > 0 and normal - coupling * u > 0:
            found.append(("slip", u))
    into = Fraction(3, 2) * coupling**2 / along  # any K_n with which the springs are stable
    gap = (along * normal - coupling * load) / (along * into - coupling**2)
    if gap < 0:  # it has left the plane
        found.append(("lift-off", gap))
    return found


def test_closed_form_has_all_states():
    given, wanted = p21.springs(), {0.5: {1}, 0.9: {1}, 1.1: {1, 3}, 2.0: {1, 3}}
    truth, numbers = p21.exact(given, 0.0), {ratio: set() for ratio in p21.RATIOS}
    for i, ratio in enumerate(given.ratio):
        states = _states(*(Fraction(float(x[i])) for x in given[:3]))
        numbers[ratio].add(len(states))
        kinds = dict(states)
        assert np.isfinite(truth.stick[i]) == ("stick" in kinds)
        assert np.isfinite(truth.slip[i]) == ("slip" in kinds)
        assert truth.lifts[i] == ("lift-off" in kinds)
        if "slip" in kinds:
            assert truth.slip[i] == pytest.approx(float(kinds["slip"]), rel=1e-12)
    assert numbers == wanted


def test_elastic_slip_of_the_sticking_points():
    given, elastic = p21.springs(), 1e-3
    u = p21.exact(given, elastic).stick
    there = np.isfinite(u)
    tau = p21.MU * (p21.NORMAL - given.coupling * u) / elastic * u
    assert (given.along * u + tau)[there] == pytest.approx(given.load[there], rel=1e-13)
    assert (np.abs(u[there]) <= elastic).all()


@pytest.mark.parametrize(("interface", "method"), RUNS)
def test_two_solutions_or_none_beyond_the_limit(interface, method):
    outcome = problems.run("P21", interface=interface, language="c", method=method)
    assert outcome.ok, outcome
    *ratios, last = outcome.says.split(". ")
    alone = "one solution (stick, slip, lift-off)"
    assert [words.partition(": ")[2] for words in ratios[:2]] == [alone, alone]
    for words in ratios[2:]:
        assert words.partition(": ")[2] == (
            "one solution (stick); two solutions in contact (stick and slip) besides lift-off; "
            "no solution in contact, only lift-off"
        )
    assert last == "Without DDTDDP the tangent is never singular"
    assert outcome.details["limit without DDTDDP"] == math.inf
    assert outcome.details["limit"] < 1e-12 and outcome.details["one correction"] < 1e-13


@pytest.mark.parametrize(("interface", "method"), RUNS)
def test_driver_without_ddtddp_is_seen(interface, method, monkeypatch):
    ask = StandardPoints.ask

    def symmetric(self, slip, pressure):
        found = ask(self, slip, pressure)
        return found._replace(by_pressure=0.0 * found.by_pressure)

    monkeypatch.setattr(StandardPoints, "ask", symmetric)
    outcome = problems.run("P21", interface=interface, language="c", method=method)
    # The states are the same; only the tangent does not know of them.
    assert not outcome.ok
    assert outcome.details["wrong counts"] == 0.0 and outcome.details["solutions"] < 1e-12
    assert outcome.details["limit"] > 1.0 and outcome.details["one correction"] > 1e-3
