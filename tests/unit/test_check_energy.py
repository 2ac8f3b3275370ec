# SPDX-License-Identifier: MIT
"""Work, SED, SFD, push and release, holds."""

from __future__ import annotations

import pytest

from tests.unit.frictions import fails, law, made, passes, refuses

_TAU = "part * trial[a];"
_SED = "*SED += 0.5 * TAU[a] * TAU[a] / k;"
_SFD = "*SFD += TAU[a] * DSLIP[a];"


def test_source_of_energy_is_caught(c_routine) -> None:
    fails(made(c_routine, "fric", _TAU, "-part * trial[a];"), "energy.dissipation", "work of fric")
    subject = made(c_routine, "vfriction", "(usub_real)-force", "(usub_real)force")
    fails(subject, "energy.dissipation", "expected 0 or more")


@pytest.mark.parametrize(
    ("new", "words"),
    [
        ("*SED += TAU[a] * TAU[a] / k;", "half of stress times elastic slip"),
        ("*SED -= 0.5 * TAU[a] * TAU[a] / k;", "0 or more"),
        ("*SED += TAU[a] * DGAM[a];", "expected"),
        ("*SED += 0.5 * TAU[a] * TAU[a] / k + 1e-4 * *KINC;", "expected"),
    ],
)
def test_elastic_energy_is_checked(c_routine, new: str, words: str) -> None:
    fails(made(c_routine, "fric", _SED, new), "energy.elastic", f"SED is .* {words}")


@pytest.mark.parametrize(
    "new",
    [
        "*SFD += TAU[a] * DSLIP[a] / *DTIME;",
        "*SFD -= TAU[a] * DSLIP[a];",
        "*SFD += TAU[a] * DGAM[a];",
        "*SFD += 0.5 * TAU[a] * DSLIP[a];",
        "*SFD += TAU[a] * DSLIP[a] / (1.1 * p);",
    ],
)
def test_dissipation_is_checked(c_routine, new: str) -> None:
    fails(made(c_routine, "fric", _SFD, new), "energy.frictional", "SFD is .* expected")


def test_what_is_not_given_is_told(c_routine) -> None:
    refuses(made(c_routine, "fric", _SED), "energy.elastic", "never sets SED")
    refuses(made(c_routine, "fric", _SFD), "energy.frictional", "never sets SFD")


def test_body_that_creeps_back_is_caught(c_routine) -> None:
    # stress as a curve of the motion so far: DSLIP is all motion, so that SLIP adds it up
    wrong = "DSLIP[a] = DGAM[a]; TAU[a] = limit * tanh(k * (SLIP[a] + DGAM[a]) / limit);"
    curve = made(c_routine, "fric", "DSLIP[a] = (1 - part) * trial[a] / k;", wrong)
    finding = fails(curve, "energy.push-release", "gives back the work .* expected at most")
    assert "elastic slip" in finding.hint
    for name in ("dahl", "iwan", "softened", "softened_rough", "lugre", "slip_weakening"):
        passes(law(name, "fric"), "energy.push-release energy.dissipation")


def test_creep_in_every_call_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "TAU[a] + k * DGAM[a]", "0.999 * TAU[a] + k * DGAM[a]")
    fails(subject, "energy.hold", "while the point is held for 100 increments")


def test_relaxation_in_time_is_no_fault(c_routine) -> None:
    subject = made(
        c_routine, "fric", "TAU[a] + k * DGAM[a]", "exp(-0.1 * *DTIME) * TAU[a] + k * DGAM[a]"
    )
    passes(subject, "energy.hold")
    passes(law("maxwell_slip", "fric"), "energy.hold")
    passes(law("rate_state_ageing", "fric"), "energy.hold")
    passes(law("dahl", "vfric"), "energy.hold")
    refuses(law("coulomb", "vfric"), "energy.hold", "no memory of the motion")
