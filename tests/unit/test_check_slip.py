# SPDX-License-Identifier: MIT
"""DSLIP: sign and size."""

from __future__ import annotations

import pytest

from tests.unit.frictions import fails, law, made, passes, refuses

_DSLIP = "DSLIP[a] = (1 - part) * trial[a] / k;"


def test_sign_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", _DSLIP, "DSLIP[a] = (part - 1) * trial[a] / k;")
    fails(subject, "slip.sign", "expected it along the motion")


def test_direction_is_caught(c_routine) -> None:
    subject = made(c_routine, "fric", _DSLIP, "DSLIP[a] = (1 - part) * trial[0] / k;")
    fails(subject, "slip.sign", "expected it along the motion")


@pytest.mark.parametrize(
    ("new", "words"),
    [
        ("DSLIP[a] = SLIP[a] + (1 - part) * trial[a] / k;", "at most .*, its size"),
        ("DSLIP[a] = (1 - part) * trial[a] / k / *DTIME;", "at most .*, its size"),
        ("DSLIP[a] = 0.5 * (1 - part) * trial[a] / k;", "no motion is elastic"),
        ("DSLIP[a] = DGAM[a];", "SED says that all the work so far is elastic"),
    ],
)
def test_size_is_caught(c_routine, new: str, words: str) -> None:
    fails(made(c_routine, "fric", _DSLIP, new), "slip.size", f"DSLIP has the size .* {words}")


def test_what_is_not_given_is_told(c_routine) -> None:
    subject = made(c_routine, "fric", _DSLIP, "DSLIP[a] = 0;")
    refuses(subject, "slip.size", "never sets DSLIP")
    refuses(subject, "slip.sign", "never sets DSLIP")


def test_laws_that_count_all_motion_as_slip_pass() -> None:
    for name in ("dahl", "damping", "maxwell_slip", "anisotropic", "slip_weakening"):
        passes(law(name, "fric"), "slip.sign slip.size")
