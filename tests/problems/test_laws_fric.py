# SPDX-License-Identifier: MIT
"""Shipped laws behind FRIC: return mapping, tangents, protocol."""

from __future__ import annotations

import numpy as np
import pytest

import usersub
from usersub import laws
from usersub.errors import RoutineError

LENGTH = 0.4
ALLOWABLE = 0.005 * LENGTH

PROPS = {
    "coulomb": [0.15],
    "exponential_decay": [0.15, 0.05, 0.01],
    "temperature_pressure_decay": [8e-4, 2.5e-5, 3e-4, 1e-5, 0.02],
    "coulomb_tabulated": [
        3, 2, 2, 1.0, 50.0, 200.0, 500.0, 2000.0, 60.0, 180.0,
        0.31, 0.27, 0.11, 0.36, 0.24, 0.19, 0.41, 0.33, 0.13, 0.28, 0.22, 0.17,
    ],
}  # fmt: skip

#: Motions of three increments: stick, slip along a turned direction, back into stick.
PATH = [
    (np.array([0.4e-3, -0.3e-3]), 800.0, 0.01),
    (np.array([0.9, 1.7]), 1300.0, 0.02),
    (np.array([-0.5e-3, -0.2e-3]), 700.0, 0.05),
]
WARM, COLD = np.array([170.0]), np.array([90.0])


def _driver(law, interface, language, **changes):
    routine = laws.routine(law, interface, language)
    settings = {
        "points": 1, "dimension": 3, "props": PROPS.get(law, [0.02]), "temperatures": 1,
        "temperature_tangent": 1, "characteristic_length": LENGTH,
        "states": 2 if interface == "fric" else 0,
    }  # fmt: skip
    return usersub.StandardDriver(routine, usersub.Scene(**{**settings, **changes}))


def _iterate(driver, motion, pressure, warm=WARM, cold=COLD):
    return driver.iterate(
        slip_increment=np.asfortranarray(np.reshape(motion, (-1, 1)).astype(float)),
        pressure=np.array([float(pressure)]),
        temperature_secondary=warm,
        temperature_main=cold,
    )


def _close(driver):
    driver.begin_increment(1.0)
    response = _iterate(driver, np.zeros(2), 500.0)
    driver.commit()
    return response


@pytest.mark.parametrize("law", PROPS)
def test_enforces_as_the_penalty_driver_does(law, language):
    # The driver's enforcement of FRIC_COEF is written independently; rounding only.
    own, driven = (_driver(law, i, language) for i in ("fric", "fric_coef"))
    _close(own)
    _close(driven)
    for motion, pressure, dt in PATH:
        results = []
        for driver in (own, driven):
            driver.begin_increment(dt)
            results.append(_iterate(driver, motion, pressure))
            driver.commit()
        for name in ("tau", "ddtddg", "ddtddp", "ddtddt", "dslip", "sed", "sfd"):
            a, b = (getattr(r, name) for r in results)
            assert a == pytest.approx(b, rel=1e-12, abs=1e-12 * (1e-30 + np.abs(b).max())), name


@pytest.mark.parametrize("law", PROPS)
def test_tangents_are_consistent(law, language):
    # Central differences with a step of 1e-5 of each variable: truncation and rounding below 1e-7.
    driver = _driver(law, "fric", language)
    _close(driver)
    for motion, pressure, dt in PATH:
        driver.begin_increment(dt)
        size = np.linalg.norm(motion) * 1e-5

        def stress(dx=(0.0, 0.0), dp=0.0, dt1=0.0, dt2=0.0, m=motion, p=pressure):
            return _iterate(driver, m + dx, p + dp, WARM + dt1, COLD + dt2).tau[:, 0]

        def central(h, **moves):
            plus = {k: np.multiply(v, h) for k, v in moves.items()}
            minus = {k: np.multiply(v, -h) for k, v in moves.items()}
            return (stress(**plus) - stress(**minus)) / (2.0 * h)

        found = _iterate(driver, motion, pressure)
        for b in range(2):
            expected = central(size, dx=np.eye(2)[b])
            scale = np.abs(found.ddtddg).max()
            assert found.ddtddg[:, b, 0] == pytest.approx(expected, rel=1e-6, abs=1e-7 * scale)
        assert found.ddtddp[:, 0] == pytest.approx(central(1e-2, dp=1.0), rel=1e-6, abs=1e-9)
        for k, name in enumerate(("dt1", "dt2")):
            expected = central(1e-2, **{name: 1.0})
            assert found.ddtddt[:, k, 0] == pytest.approx(expected, rel=1e-6, abs=1e-8)
        _iterate(driver, motion, pressure)
        driver.commit()


@pytest.mark.parametrize("law", ["coulomb", "viscoplastic_creep"])
def test_closing_increment_is_frictionless(law, language):
    response = _close(_driver(law, "fric", language))
    assert response.lm.tolist() == [2]
    assert not response.tau.any()


def test_reopened_point_has_forgotten_its_elastic_slip(language):
    driver = _driver("coulomb", "fric", language)
    _close(driver)
    for pressure in (900.0, -1.0, 900.0):
        driver.begin_increment(0.1)
        _iterate(driver, [1.0, 0.0], pressure)
        driver.commit()
    driver.begin_increment(0.1)
    response = _iterate(driver, [0.25 * ALLOWABLE, 0.0], 900.0)
    assert response.tau[0, 0] == pytest.approx(0.25 * 0.15 * 900.0, rel=1e-14)


def test_one_friction_direction(language):
    driver = _driver("coulomb", "fric", language, dimension=2, states=1)
    driver.begin_increment(1.0)
    _iterate(driver, [0.0], 500.0)
    driver.commit()
    driver.begin_increment(0.1)
    response = _iterate(driver, [-3.0 * ALLOWABLE], 700.0)
    assert response.tau[0, 0] == pytest.approx(-0.15 * 700.0, rel=1e-15)
    assert response.dslip[0, 0] == pytest.approx(-2.0 * ALLOWABLE, rel=1e-14)
    assert response.sfd[0] == pytest.approx(2.0 * ALLOWABLE * 105.0, rel=1e-14)
    assert response.sed[0] == pytest.approx(0.5 * ALLOWABLE * 105.0, rel=1e-14)
    assert response.ddtddg[0, 0, 0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"states": 1}, "keeps its elastic slip in"),
        ({"characteristic_length": 0.0}, "needs a characteristic length above zero"),
        ({"props": []}, "needs 1 properties, not 0|has too few properties"),
    ],
)
def test_scene_that_does_not_fit_is_refused(changes, told, language):
    driver = _driver("coulomb", "fric", language, **changes)
    _close(driver)
    driver.begin_increment(0.1)
    with pytest.raises(RoutineError, match=told):
        _iterate(driver, [1.0, 0.5], 900.0)


def test_creep_needs_time(language):
    driver = _driver("viscoplastic_creep", "fric", language, states=0)
    _close(driver)
    driver.begin_increment(0.0)
    with pytest.raises(RoutineError, match="needs a time increment"):
        _iterate(driver, [1.0, 0.5], 900.0)
