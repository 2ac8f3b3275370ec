# SPDX-License-Identifier: MIT
"""Derivatives of Fortran laws by differences: how good they are, on curves that are hard."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from mpmath import mpf, workdps

import usersub
from tests.unit import fortran_laws as model

pytestmark = pytest.mark.needs_fortran


@pytest.fixture(autouse=True)
def _digits():
    with workdps(model.DIGITS):
        yield


CURVES = """\
    select case (nint(props(1)))
    case (1)
      answer = 0.05_wp + 0.1_wp*bounded_exp(-props(2)*rate)
    case (2)
      answer = 0.1_wp + 0.05_wp*exp(-(props(2)*rate)**2) + 0.3_wp*props(2)*rate
    case (3)
      answer = 0.3_wp*(props(2)*rate + 1e-3_wp)**(-0.2_wp)
    case (4)
      answer = 0.005_wp*asinh(props(2)*rate)
    case (5)
      answer = max(0.1_wp, 0.2_wp*props(2)*rate)
    case (6)
      answer = 0.3_wp*tanh(props(2)*rate)/(props(2)*rate + 1e-3_wp)
    case default
      answer = 0.3_wp + 1e-3_wp*tanh(props(2)*rate - 900)
    end select"""

TRUE_CURVES = (
    lambda x: mpf("0.05") + mpmath.exp(-x) / 10,
    lambda x: mpf("0.1") + mpmath.exp(-x * x) / 20 + x * mpf("0.3"),
    lambda x: mpf("0.3") * (x + mpf("1e-3")) ** mpf("-0.2"),
    lambda x: mpmath.asinh(x) / 200,
    lambda x: max(mpf(1) / 10, x / 5),
    lambda x: mpf("0.3") * mpmath.tanh(x) / (x + mpf("1e-3")),
    lambda x: mpf("0.3") + mpf("1e-3") * mpmath.tanh(x - 900),
)


@pytest.fixture(scope="module")
def curves(tmp_path_factory, fortran):
    law = model.Law(
        "curves", "coefficient", model.SCALAR, ("PROPS 2", "READS_RATE"), CURVES, "", (),
        lambda q, p: None,
    )  # fmt: skip
    path = tmp_path_factory.mktemp("curves") / "curves.f90"
    path.write_text(law.source(differences=True))
    return usersub.load(path)["fric_coef"]


@pytest.mark.parametrize("unit", [2.0**-40, 1.0, 2.0**30])
@pytest.mark.parametrize("curve", range(1, 8))
def test_differences_are_as_good_as_they_say(curves, curve, unit):
    """Whatever the unit of the variable, at its bound, at a kink (from above) and near it, far out
    in a decay, and on a step that is much narrower than its distance from zero."""
    at = [0.0, 1e-9, 1e-3, 0.02, 0.3, 0.4999, 0.5, 0.5001, 1.0, 2.7, 20.0, 600.0]
    if curve == 7:
        at = [850.0, 899.5, 900.0, 900.5, 1000.0]
    x = np.array(at) * unit
    scene = usersub.Scene(points=x.size, props=[curve, 1 / unit], derivatives=1)
    driver = usersub.CoefficientDriver(curves, scene)
    slip_data = np.zeros((6, x.size), order="F")
    slip_data[0] = x
    value = driver.evaluate(slip_data=slip_data, pressure=np.ones(x.size), time_increment=1.0)
    found = driver.array("derivative")[0]
    true = TRUE_CURVES[curve - 1]
    truth = [(true(mpf(v) + model.STEP) - true(mpf(v))) / model.STEP for v in at]
    truth = np.array(truth, float) / unit
    rounding = 1e-13 * value / np.where(x > 0, x, 1e-2 * unit)
    assert (np.abs(found - truth) <= 1e-10 * np.abs(truth) + rounding).all()
