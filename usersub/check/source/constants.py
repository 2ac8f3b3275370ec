# SPDX-License-Identifier: MIT
"""COMMON blocks of Fortran that hold constants: nothing in the file changes them after they have
begun with the values of a DATA statement, or were filled where the solver starts the analysis."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from usersub.check.rule import CannotCheck, NotApplicable
from usersub.check.source import arguments
from usersub.errors import Error
from usersub.routine import fortran_text

if TYPE_CHECKING:
    from usersub.check.source.statics import Static
    from usersub.check.subject import Subject

_BLOCK = re.compile(r"^COMMON /(\w+)/")
#: The parts of a COMMON statement: a name between slashes and the variables behind it.
_COMMON = re.compile(r"/(\w*)/([^/]*)")
#: Entries that the solver calls before the first contact.
_START = ("uexternaldb", "vexternaldb")
#: Statements in which a name need not stand before "=" to be changed.
_CHANGES = re.compile(r"\b(?:read|call|equivalence|entry|namelist|inquire|open|pointer|allocate)\b")
#: Statements that say how a variable begins, or declare it.
_BEGINS = re.compile(
    r"^(?:data|parameter|common|dimension|save|include|integer|real|doubleprecision|logical|"
    r"character)(?![a-z0-9_]*=)"
)


def constant(subject: Subject, static: Static) -> bool:
    """Whether a COMMON block that a BLOCK DATA or UEXTERNALDB fills is changed nowhere else.

    In doubt it is not: a block that other files may have, too, counts if this file fills it.
    """
    named = _BLOCK.match(static.people)
    if named is None:
        return False
    try:
        source = arguments.source_of(subject)
        text = source.text()
    except (CannotCheck, NotApplicable, Error, OSError):
        return False
    free = fortran_text.is_free(source.path.suffix, text)
    units = fortran_text.units(text, free, source.path.name)
    block = named[1].lower()
    names = {name for unit in units for name in _variables(unit, block)}
    filled = any(
        s.code.startswith("data") and any(re.search(rf"\b{n}\b", s.text) for n in names)
        for unit in units if unit.kind.startswith("block") for s in unit.statements
    )  # fmt: skip
    changing = [
        unit.name.lower() for unit in units
        if (_variables(unit, block) or unit.kind == "module")
        and any(_changes(s, names) for s in unit.statements)
    ]  # fmt: skip
    filled = filled or any(name in _START for name in changing)
    return filled and all(name in _START for name in changing)


def _variables(unit: fortran_text.Unit, block: str) -> set[str]:
    """Names of the variables of a COMMON block in a program unit."""
    found: set[str] = set()
    for statement in unit.statements:
        if not statement.code.startswith("common/"):
            continue
        for name, variables in _COMMON.findall(statement.code):
            if name == block:
                plain = re.sub(r"\([^)]*\)", "", variables)
                found |= {v for v in plain.split(",") if v}
    return found


def _changes(statement: fortran_text.Statement, names: set[str]) -> bool:
    if not any(re.search(rf"\b{name}\b", statement.text) for name in names):
        return False
    if _CHANGES.search(statement.text):
        return True
    if _BEGINS.match(statement.code):
        return False
    targets = "|".join(map(re.escape, sorted(names)))
    # An assignment, also behind IF (...), and the variable of a loop.
    loop, index = r"(?:do\s+(?:\d+\s*,?\s*)?)?", r"\s*(?:\([^=]*\)\s*)?"
    assigned = rf"(?:^|[\s)]){loop}(?:{targets}){index}=(?!=)"
    return bool(re.search(assigned, statement.text))
