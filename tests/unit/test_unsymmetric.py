# SPDX-License-Identifier: MIT
"""What of the tangents a symmetric solver would lose, and that it is told."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import SceneError

SLIP = np.asfortranarray([[0.3, -0.2, 0.001], [0.4, 0.1, 0.002]])
PRESSURE = np.array([2.0, 5.0, 3.0])


@usersub.fric_coef
def law(fCoef, fCoefDeriv, slipData, pressure, props):
    """props: level, rate, pressure weight, second over first coefficient (0: one)."""
    mu = props[0] * math.exp(-props[1] * slipData[0, 0] - props[2] * pressure[0])
    for k in range(2 if props[3] > 0.0 else 1):
        factor = props[3] if k else 1.0
        fCoef[0, k] = factor * mu
        fCoefDeriv[0, 0, k] = -factor * props[1] * mu
        fCoefDeriv[0, 1, k] = -factor * props[2] * mu


@usersub.fric
def given(LM, DDTDDG, DDTDDP, TAU, PROPS):
    """A tangent that is no law's: of point 1 in the properties."""
    LM[0] = int(PROPS[6])
    TAU[:] = 0.0
    for i in range(2):
        DDTDDP[i] = PROPS[4 + i]
        for j in range(2):
            DDTDDG[i, j] = PROPS[2 * i + j]


def ask(props, pressure=PRESSURE, routine=law, **settings):
    method = {"elastic_slip": 0.01} if routine is law else {}
    scene = usersub.Scene(points=3, dimension=3, props=props, **{**method, **settings})
    driver = usersub.StandardDriver(routine, scene)
    driver.bind(multiplier=np.zeros((2, 3), order="F"))
    driver.begin_increment(0.1)
    return driver, driver.iterate(slip_increment=SLIP, pressure=pressure)


def test_coulomb():
    """In slip d tau/d p is mu, in stick mu times the part of the allowable elastic slip."""
    driver, found = ask([0.15, 0, 0, 0])
    told = driver.symmetry()
    part = math.hypot(0.001, 0.002) / 0.01
    assert told.pressure == pytest.approx([0.15, 0.15, 0.15 * part], rel=1e-14)
    assert not told.skew.any() and told.unsymmetric and not told.solver_switches
    assert told.pressure == pytest.approx(np.linalg.norm(found.ddtddp, axis=0), rel=1e-14)
    assert "unsymmetric at 3 of 3 closed points" in told.sentence
    assert "d tau/d p, which has no counterpart, is up to 0.15 (point " in told.sentence
    assert "converges linearly to the same answer" in told.sentence
    assert "commercial" not in told.sentence and "skew" not in told.sentence


@pytest.mark.parametrize(
    ("props", "switches"),
    [
        ([0.2, 0, 0, 0], False),
        ([0.2000001, 0, 0, 0], True),
        ([0.1, 0, 1e-3, 0], True),  # dependent on pressure
        ([0.1, 1.0, 0, 0], False),
    ],
)
def test_when_the_commercial_solver_switches(props, switches):
    told = ask(props)[0].symmetry()
    assert told.solver_switches == switches == ("commercial solver" in told.sentence)


def test_two_coefficients_that_depend_on_the_rate():
    driver, found = ask([0.3, 0.2, 0.0, 1.7], anisotropic=1)
    told = driver.symmetry()
    for p in range(3):
        tangent = found.ddtddg[:, :, p]
        skew = np.linalg.norm(tangent - tangent.T) / 2 / np.linalg.norm(tangent)
        assert told.skew[p] == pytest.approx(skew, rel=1e-9, abs=1e-15)
    worst = int(np.argmax(told.skew))
    assert told.skew[worst] > 0.01
    assert f"skew part of up to {told.skew[worst]:.3g} of it (point {worst})" in told.sentence


def test_a_fric_of_its_own():
    told = ask([2.0, 1.0, 0.0, 2.0, 0.3, 0.4, 0.0], routine=given)[0].symmetry()
    assert told.skew == pytest.approx([math.sqrt(0.5) / 3.0] * 3, rel=1e-15)
    assert told.pressure == pytest.approx([0.5] * 3, rel=1e-15)
    assert told.solver_switches
    for lm in (1.0, 2.0):  # constrained, frictionless: no tangent
        told = ask([2.0, 1.0, 0.0, 2.0, 0.3, 0.4, lm], routine=given)[0].symmetry()
        assert not told.unsymmetric and not told.skew.any() and not told.pressure.any()
        assert told.sentence == "symmetric: a symmetric solver loses nothing"


def test_open_points_count_for_nothing():
    told = ask([0.15, 0, 0, 0], pressure=np.array([2.0, 0.0, -1.0]))[0].symmetry()
    assert "unsymmetric at 1 of 1 closed points" in told.sentence
    assert told.pressure.tolist() == pytest.approx([0.15, 0, 0])


def test_points_that_stick_by_multipliers():
    driver, _ = ask([0.15, 0, 0, 0], enforcement="lagrange")
    assert not driver.symmetry().unsymmetric


def test_one_direction_has_no_skew_part():
    scene = usersub.Scene(dimension=2, props=[0.3, 0.5, 0.1, 0.0], elastic_slip=0.01)
    driver = usersub.StandardDriver(law, scene)
    driver.begin_increment(0.1)
    driver.iterate(slip_increment=np.full((1, 1), 0.2), pressure=np.ones(1))
    told = driver.symmetry()
    assert told.skew.tolist() == [0.0] and told.pressure[0] > 0.05


def test_refusals():
    driver, _ = ask([0.15, 0, 0, 0])
    with pytest.raises(SceneError, match="pressure"):
        driver.iterate(pressure=np.full(3, np.nan))
    with pytest.raises(SceneError, match="needs usub_iterate|needs a usub_iterate"):
        driver.symmetry()
    driver, _ = ask([0.15, 0, 0, 0], tangent=0)
    with pytest.raises(SceneError, match="'tangent' is 0"):
        driver.symmetry()
