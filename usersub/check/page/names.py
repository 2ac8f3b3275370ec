# SPDX-License-Identifier: MIT
"""What load and response are called in figures, with their units in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from usersub.check.rule import COEFFICIENT

if TYPE_CHECKING:
    from usersub.check.subject import Subject


def ratio_name(subject: Subject) -> str:
    """What the response over load is called."""
    if subject.interface.name == "fric_coef" and subject.anisotropic:
        return "friction coefficient of direction 1"
    return {
        "fric": "friction stress over pressure",
        "vfric": "friction force over normal force",
        "vfriction": "friction force over normal force",
    }.get(subject.interface.name, "friction coefficient")


def load_name(subject: Subject) -> str:
    """What the load is called, with its unit."""
    if subject.interface.name in ("vfric", "vfriction"):
        return "normal force [force]"
    return "pressure [stress]"


def load_plural(subject: Subject) -> str:
    """Several loads in words."""
    return "normal forces" if subject.interface.name in ("vfric", "vfriction") else "pressures"


def friction_name(subject: Subject) -> str:
    """What the response is called, with its unit."""
    if subject.interface.name in COEFFICIENT:
        return "friction coefficient [-]"
    force = subject.interface.name != "fric"
    return "friction force [force]" if force else "friction stress [stress]"
