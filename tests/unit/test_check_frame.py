# SPDX-License-Identifier: MIT
"""Rotation, reversal and turns: what is caught, and what is left alone."""

from __future__ import annotations

import pytest

from tests.unit.frictions import fails, law, made, passes, refuses

_SIZE = "const double size = hypot(trial[0], trial[1]);"


def test_friction_by_components_is_caught(c_routine) -> None:
    # tanh of each component, the usual regularisation
    subject = made(
        c_routine,
        "fric",
        "TAU[a] = part * trial[a];",
        "TAU[a] = limit * tanh(trial[a] / limit);",
    )
    finding = fails(subject, "frame.rotation", r"friction in increment .* turned by \d+ degrees")
    assert "one component after the other" in finding.hint
    passes(subject, "frame.reversal")


def test_sum_of_components_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", _SIZE, "const double size = fabs(trial[0]) + fabs(trial[1]);")
    fails(subject, "frame.rotation", "turned by")


def test_signed_size_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", "size > limit", "size > limit && trial[0] > 0")
    fails(subject, "frame.reversal", "when all motions are reversed; expected -")


def test_signed_slip_rate_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric_coef", "rate = slipData[0]", "rate = slipData[1]")
    fails(subject, "frame.reversal", "coefficient in increment .* expected")


def test_stale_direction_is_caught(c_routine) -> None:
    # the stress keeps the direction in which it began to slip
    subject = made(
        c_routine,
        "fric",
        "TAU[a] = part * trial[a];",
        "TAU[a] = hypot(TAU[0], n > 1 ? TAU[1] : 0) >= 0.99 * limit ? TAU[a] : part * trial[a];",
    )
    finding = fails(subject, "frame.turn", "increments that follow a turn of the motion")
    assert finding.figures["point"] == 0
    fails(subject, "frame.reversal", "increments that follow a turn|reversed")


def test_force_by_the_last_force_is_caught(c_routine) -> None:
    subject = made(
        c_routine,
        "vfriction",
        "fTangential[2 * k] = (usub_real)-force;",
        "const double old = hypot(fTangPrev[3 * k], fTangPrev[3 * k + 1]);"
        "for (int a = 0; a < 2; ++a) fTangential[2 * k + a] = (usub_real)(old > 0 ? force * "
        "fTangPrev[3 * k + a] / old : -force * (a == 0));",
    )
    fails(subject, "frame.turn", "follow a turn")


def test_anisotropy_is_no_fault() -> None:
    refuses(law("anisotropic", "fric"), "frame.rotation", "preferred directions")
    passes(law("anisotropic", "fric"), "frame.reversal frame.turn")
    passes(law("anisotropic", "fric_coef"), "frame.rotation frame.reversal")


@pytest.mark.parametrize("interface", ["fric", "vfric"])
def test_what_forgets_nothing_is_no_fault(interface: str) -> None:
    refuses(law("softened_rough", interface), "frame.turn", "forgets nothing")


def test_law_that_jumps_at_rest_is_no_fault() -> None:
    passes(law("rate_state_ageing", "fric"), "frame.rotation frame.reversal frame.turn")
