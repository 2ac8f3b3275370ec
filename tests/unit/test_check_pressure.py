# SPDX-License-Identifier: MIT
"""Zero and negative pressure, no motion, no area, no time, no friction."""

from __future__ import annotations

import pytest

from tests.unit.frictions import fails, law, made, passes, refuses

_P = "const double p = *PRESS > 0 ? *PRESS : 0,"


def test_absolute_pressure_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", _P, "const double p = fabs(*PRESS),")
    finding = fails(subject, "pressure.negative", r"tau = .* at pressure -1; expected at most 0")
    assert "max(PRESS, 0)" in finding.hint
    passes(subject, "pressure.zero")


def test_signed_pressure_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", _P, "const double p = *PRESS,")
    fails(subject, "pressure.negative", "at pressure -1")


def test_division_by_pressure_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "part * trial[a];", "part * trial[a] / p * p;")
    fails(subject, "pressure.zero", "at pressure 0 .*TAU.* = -?nan")
    # a comparison with NaN says no: the point sticks with all the stress of the trial
    subject = made(c_routine, "fric", "size > limit;", "size / p > limit / p;")
    fails(subject, "pressure.zero", "tau = .* at pressure 0; expected at most")


def test_friction_at_no_force_is_caught(c_routine) -> None:
    wrong = "if (!(fNormal[k] > 0)) { fTangential[2 * k] = -(usub_real)props[0]; continue; }"
    subject = made(c_routine, "vfriction", "if (!(fNormal[k] > 0)) continue;", wrong)
    fails(subject, "pressure.zero", "friction force = .* at normal force 0; expected at most")


def test_infinite_coefficient_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric_coef", "- 1e-4 * tempAvg[0];", "* pow(p, -0.1);")
    fails(subject, "pressure.zero", "at pressure 0 .*fCoef = inf")


@pytest.mark.parametrize("name", ["cohesion", "tresca", "damping", "norton_hoff"])
def test_adhesion_and_viscosity_are_no_fault(name: str) -> None:
    passes(law(name, "fric"), "pressure.zero pressure.negative zero.slip")
    passes(law(name, "vfric"), "pressure.zero")


def test_direction_of_no_motion_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "part * trial[a];", "part * size * (trial[a] / size);")
    fails(subject, "zero.slip", "without motion .*TAU.* = -?nan")


def test_stress_from_nothing_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "part * trial[a];", "part * trial[a] + 1e-3 * p;")
    fails(subject, "zero.slip", "has never moved; expected 0")


def test_direction_made_up_at_rest_is_caught(c_routine) -> None:
    wrong = "DGAM[0] == 0 && a ? 0.5 * limit : part * trial[a];"
    subject = made(c_routine, "fric", "part * trial[a];", f"size > 0 && {wrong}")
    fails(subject, "zero.slip", "after a slide along")


def test_area_of_zero_is_caught(c_routine) -> None:
    subject = made(c_routine, "vfriction", "areaCont[k] > 0 ? fNormal[k] / areaCont[k] : 0",
                   "fNormal[k] / areaCont[k]")  # fmt: skip
    fails(subject, "zero.area", "contact area of 0")


def test_time_of_zero_is_caught(c_routine) -> None:
    wrong = "weak = 1 - 1e-3 * heat + 0 * (DGAM[0] / *DTIME);"
    subject = made(c_routine, "fric", "weak = 1 - 1e-3 * heat;", wrong)
    fails(subject, "zero.time-step", "time increment of 0 .*nan")


def test_refused_time_of_zero_is_no_fault() -> None:
    refuses(law("damping", "fric"), "zero.time-step", "refuses it")


def test_no_friction_is_told(c_routine) -> None:
    subject = made(c_routine, "fric").but(props=(0.0, 100.0))
    fails(subject, "friction.present", r"friction is 0 in all 5 increments .*properties 0, 100")
    wrong = "a ? 0 : part * trial[a];"
    second = made(c_routine, "fric", "part * trial[a];", wrong)
    fails(second, "friction.present", r"slide along \(.*, 1\)")
    none = law("frictionless", "fric")
    fails(none, "friction.present", "properties none")
    refuses(none.but(law="frictionless"), "friction.present", "stands for the law frictionless")
    refuses(law("rough", "fric"), "friction.present", "LM = 1")


def test_friction_that_grows_as_the_pressure_falls_is_caught(c_routine) -> None:
    wrong = "limit = p > 0 ? mu / p : 0;"
    subject = made(c_routine, "fric", "limit = mu * p;", wrong).but(props=(0.3, 1e9))
    fails(subject, "pressure.zero", "expected it not to grow as the pressure falls to 0")


def test_stress_that_stays_at_rest_under_less_pressure_is_caught(c_routine) -> None:
    wrong = "slips = size > limit && hypot(DGAM[0], n > 1 ? DGAM[1] : 0) > 0;"
    subject = made(c_routine, "fric", "slips = size > limit;", wrong)
    fails(subject, "bound.cone", "expected at most")
