# SPDX-License-Identifier: MIT
"""Rules of mechanics say nothing of whole routines."""

from __future__ import annotations

import pytest

from tests.unit.frictions import found, groups, made
from usersub.check.rule import RULES, CannotCheck, NotApplicable

_GROUPS = (
    "friction",
    "zero",
    "pressure",
    "bound",
    "frame",
    "slip",
    "multiplier",
    "pnewdt",
    "energy",
    "tangent",
    "limits",
)


@pytest.mark.parametrize("interface", ["fric", "vfriction", "fric_coef"])
def test_whole_routines_pass(c_routine, interface: str) -> None:
    subject = made(c_routine, interface)
    refused = {}
    for name in groups(*_GROUPS):
        if interface not in RULES[name].interfaces or RULES[name].severity == "note":
            continue
        try:
            finding = found(subject, name)
        except (NotApplicable, CannotCheck) as reason:
            refused[name] = str(reason)
            continue
        assert finding is None, f"{name}: {finding}"
    if interface == "vfriction":
        assert "no memory of the motion" in refused.pop("energy.hold")
    assert not refused
