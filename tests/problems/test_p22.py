# SPDX-License-Identifier: MIT
"""P22: flutter of coupled modes against eigenvalues and the exponential of the whole system."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from usersub import problems
from usersub.problems import p22
from usersub.problems.sliding_points import StandardPoints

POINTS = len(p22.COUPLING)


def _whole(stiffness, point):
    """First-order matrix of one mass with the friction that its pressure makes."""
    k = stiffness[:, :, point].copy()
    k[0, 1] -= p22.MU * p22.CONTACT
    return np.block([[np.zeros((2, 2)), np.eye(2)], [-k, -2.0 * p22.DAMPING * np.eye(2)]])


def test_growth_and_condition_of_flutter():
    stiffness = p22.system(POINTS).stiffness
    growth, flutters = p22.exact(stiffness).growth, p22.discriminant(stiffness) < 0.0
    for point in range(POINTS):
        values = np.linalg.eigvals(_whole(stiffness, point))
        assert growth[point] == pytest.approx(values.real.max(), abs=1e-12)
        assert (values.real.max() > 0.0) == flutters[point]
    assert flutters.tolist() == [True] * 4 + [False] * 4
    limit = p22.critical(stiffness[0, 1])
    for point in np.flatnonzero(~np.isnan(limit)):
        for share, pair in ((1.0 - 1e-6, True), (1.0 + 1e-6, False)):
            near = stiffness[:, :, [point]].copy()
            near[0, 0] = near[1, 1] + share * limit[point]
            assert (p22.discriminant(near)[0] < 0.0) == pair
    # Friction cannot reach these, however close the stiffnesses are.
    assert np.isnan(limit[6:]).all()


@pytest.mark.parametrize("time", [0.7, 30.0])
def test_motion_by_the_exponential_of_the_matrix(time):
    stiffness = p22.system(POINTS).stiffness
    place = np.array([np.sin(1.0 + np.arange(POINTS)), np.linspace(-1.0, 1.0, POINTS)])
    at, speed = p22.motion(stiffness, place, time)
    share = p22.amplitude(stiffness, at, speed) / p22.amplitude(stiffness, place, 0.0 * place)
    for point in range(POINTS):
        start = np.concatenate([place[:, point], [0.0, 0.0]])
        found = expm(time * _whole(stiffness, point)) @ start
        assert at[:, point] == pytest.approx(found[:2], abs=1e-11)
        assert speed[:, point] == pytest.approx(found[2:], abs=1e-11)
    assert np.log(share) / time == pytest.approx(p22.exact(stiffness).growth, abs=1e-12)


def test_pressure_and_slip_keep_their_sign():
    # What is linear in the closed form: contact is not lost, slip does not turn back.
    masses = p22.system(POINTS)
    place = p22.AMPLITUDE * np.array([np.sin(1.0 + np.arange(POINTS)), np.ones(POINTS)])
    for time in np.linspace(0.0, p22.TIME, 200):
        at, speed = p22.motion(masses.stiffness, place, time)
        assert masses.pressure_at(at).min() > 0.5 * p22.PRELOAD
        assert np.abs(speed[0]).max() < 0.1 * p22.SPEED


@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_symmetric_part_misses_all_flutter(interface):
    outcome = problems.run("P22", interface=interface, language="c", method="modes")
    assert outcome.ok, outcome
    details = outcome.details
    assert details["flutter"] == details["symmetric misses"] == 4.0
    assert details["flutter by the symmetric part"] == details["flutter without DDTDDP"] == 0.0
    assert outcome.says.startswith("flutter of 4 of 8 masses, growing by up to 0.0606 1/s")
    assert outcome.says.endswith("the symmetric part of the tangent misses 4 of 4")


def test_driver_without_ddtddp_is_seen(monkeypatch):
    ask = StandardPoints.ask

    def symmetric(self, slip, pressure):
        found = ask(self, slip, pressure)
        return found._replace(by_pressure=0.0 * found.by_pressure)

    monkeypatch.setattr(StandardPoints, "ask", symmetric)
    outcome = problems.run("P22", interface="fric_coef", language="c", method="modes")
    assert outcome.details["wrong points"] == 4.0 and not outcome.ok


@pytest.mark.parametrize(
    ("interface", "method"),
    [(i, p22.PROBLEM.methods[i][-1]) for i in p22.PROBLEM.interfaces],
)
def test_motion_grows_or_fades(interface, method):
    errors = []
    for steps in (600, 1200):
        outcome = problems.run("P22", interface=interface, language="c", method=method, steps=steps)
        assert outcome.ok and outcome.details["wrong points"] == 0.0
        errors.append([outcome.details["motion"], outcome.details["growth"]])
    assert np.log2(np.divide(*errors)) == pytest.approx([2.0, 2.0], abs=0.05)
    assert "4 of 8 masses grow" in outcome.says and "4 of 8 masses fade by 0.01 1/s" in outcome.says
