# SPDX-License-Identifier: MIT
"""Coefficients of every law behind FRIC_COEF and VFRIC_COEF against the reference values."""

from __future__ import annotations

import law_cases
import numpy as np
import pytest
from law_cases import column, floats

import usersub
from usersub import laws


def _evaluated(law, interface, precision, language, case, dt, points):
    """The driver after one call at `points`."""
    described = laws.law(law)
    standard = interface == "fric_coef"
    settings = {"precision": precision}
    if standard:
        settings |= {"derivatives": 1, "anisotropic": int(described.anisotropic)}
    scene = usersub.Scene(**law_cases.scene_of(law, case, interface, points, **settings))
    routine = laws.routine(law, interface, language, precision=precision)
    driver = usersub.CoefficientDriver(routine, scene)
    rate = column(points, "slip_rate")
    if standard:
        # Every entry has its own value; a law reads the magnitude of the rate.
        data = np.arange(6.0 * len(points)).reshape(6, -1, order="F") + 1000.0
        data[0], data[1], data[2] = rate, 0.6 * rate, -0.8 * rate
        arrays = {"slip_data": data}
    else:
        arrays = {"slip_rate": rate}
    arrays |= {name: column(points, name) for name in ("pressure", "temperature")}
    if scene.fields:
        arrays["field"] = column(points, "fields")
    if scene.states:
        driver.state["state"][...] = column(points, "state")
    real = law_cases.REAL[precision]
    arrays = {k: np.asfortranarray(a.astype(real)) for k, a in arrays.items()}
    driver.evaluate(time_increment=dt, **arrays)
    return driver


@pytest.mark.parametrize(
    ("law", "interface", "precision"), law_cases.combinations(("fric_coef", "vfric_coef"))
)
def test_coefficients(law, interface, precision, language):
    described = laws.law(law)
    for case in law_cases.reference(law):
        for dt, points in law_cases.by_time_increment(case["points"]):
            driver = _evaluated(law, interface, precision, language, case, dt, points)
            exact = law_cases.result(points, precision, "value")
            found = [driver.array("coefficient")]
            if described.anisotropic:
                found.append(driver.array("second_coefficient"))
            key = (law, interface, precision, language)
            for i, values in enumerate(found):
                law_cases.assert_units(key, values, [v[i] for v in exact])
            if described.states:
                expected = floats(law_cases.result(points, precision, "state")).T
                tolerance = law_cases.relative(law, precision)
                assert driver.state["state"] == pytest.approx(expected, rel=tolerance)
            if interface == "fric_coef":
                _check_derivatives(driver.array("derivative"), points)


def _check_derivatives(found: np.ndarray, points: list[dict]) -> None:
    """By slip rate, pressure, temperature."""
    expected = floats(law_cases.result(points, "double", "derivative"))[:, 0, :3].T
    compared = np.isfinite(expected)
    # A derivative may be a difference of nearly equal numbers, far smaller than the coefficient
    # by the variable: hence the floor.
    values = np.abs(floats(law_cases.result(points, "double", "value"))[:, 0])
    sizes = np.array([np.maximum(column(points, n), 1e-300) for n in
                      ("slip_rate", "pressure", "temperature")])  # fmt: skip
    floor = np.where(sizes > 1e-300, 4e-15 * values / np.abs(sizes), 1e-25)
    error = np.abs(found - expected)[compared]
    allowed = (law_cases.RELATIVE * np.abs(expected) + floor)[compared]
    assert (error <= allowed).all(), (found, expected)
