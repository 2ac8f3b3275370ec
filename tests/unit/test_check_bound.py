# SPDX-License-Identifier: MIT
"""The cone, the stick force, the direction of friction, the sign of a coefficient."""

from __future__ import annotations

import pytest

from tests.unit.frictions import fails, law, made, passes, refuses


def test_pressure_of_the_start_is_caught(c_routine) -> None:
    wrong = "limit = mu * (*PRESS - *DPRESS > 0 ? *PRESS - *DPRESS : p);"
    subject = made(c_routine, "fric", "limit = mu * p;", wrong)
    finding = fails(subject, "bound.cone", r"\|tau\| is .*; expected at most .* under the load")
    assert finding.figures["bound"] > 0


def test_stress_that_is_not_brought_back_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "size > limit;", "size > limit && TAU[0] >= 0;")
    fails(subject, "bound.cone", "expected at most")


def test_bristles_and_ageing_are_no_fault() -> None:
    for name in ("dahl", "lugre", "maxwell_slip", "rate_state_ageing", "softened_rough"):
        passes(law(name, "fric"), "bound.cone bound.opposes-slip")


def test_stick_force_is_looked_at(c_routine) -> None:
    subject = made(c_routine, "vfriction", "if (force > fStickForce[k]) force = fStickForce[k];")
    finding = fails(subject, "bound.stick-force", "expected at most 0.001, the stick force")
    assert "fStickForce" in finding.hint
    for interface in ("vfric", "vfriction"):
        refuses(law("dahl", interface), "bound.stick-force", "elastic at first")
        passes(law("damping", interface), "bound.stick-force bound.opposes-slip bound.cone")


def test_sign_of_the_force_is_caught(c_routine) -> None:
    subject = made(c_routine, "vfriction", "(usub_real)-force", "(usub_real)force")
    fails(subject, "bound.opposes-slip", r"fTangential\(1\) = 0.* pushes along the slip")


def test_sign_of_the_stress_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "part * trial[a];", "-part * trial[a];")
    finding = fails(subject, "bound.opposes-slip", "TAU has the component -.* along the motion")
    assert "DGAM" in finding.hint


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_elastic_friction_may_push_when_the_motion_turns(interface: str) -> None:
    refuses(law("softened_rough", interface), "bound.opposes-slip", "brings its own stick")


def test_negative_coefficient_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric_coef", "part = exp(-rate)", "part = 1 - 0.5 * rate")
    fails(subject, "bound.coefficient", "the coefficient is -.* at slip rate")


def test_limits_that_are_exchanged_are_told(c_routine) -> None:
    for interface in ("vfriction", "fric_coef"):
        subject = made(c_routine, interface)
        passes(subject, "limits.rate")
        fails(subject.but(props=(0.2, 0.3)), "limits.rate", "rises from .* at rest to")
        refuses(subject.but(law="stribeck"), "limits.rate", "law.agrees")
    refuses(law("norton_hoff", "vfric"), "limits.rate", "no limit")
    refuses(law("stribeck", "vfric", cv=0.1), "limits.rate", "no limit")


def test_hidden_division_of_zero_by_zero_is_named(c_routine) -> None:
    wrong = "slips = size > limit * (1 + 0 * (DGAM[0] / fabs(DGAM[0])));"
    subject = made(c_routine, "fric", "slips = size > limit;", wrong)
    finding = fails(subject, "bound.cone", "expected at most")
    assert "0/0" in finding.hint
