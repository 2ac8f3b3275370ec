# SPDX-License-Identifier: MIT
"""Local variables that the compiler sees to be used before they are set."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from usersub.check.rule import CannotCheck, NotApplicable
from usersub.check.source import arguments
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.source.again import Warned
    from usersub.check.subject import Subject

_NAME = re.compile(r"'([^']+)' (?:is|may be) used uninitialized")
_OPTIONS = ("-Wuninitialized", "-Wmaybe-uninitialized")


def warned(subject: Subject) -> list[Warned]:
    """Uses of unset variables that the compiler sees, in the source's order."""
    try:
        source = arguments.source_of(subject)
        found = source.warnings("-O2", "-Wall", *_OPTIONS)
    except (CannotCheck, NotApplicable, Error):
        return []
    return sorted((w for w in found if w.option in _OPTIONS), key=lambda w: w.line)


def named(warned: list[Warned]) -> str:
    """The variables and where they are used, in words."""
    names = [f"{m[1]} ({w.where})" for w in warned if (m := _NAME.search(w.words))]
    return ", ".join(dict.fromkeys(names))
