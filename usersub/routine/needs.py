# SPDX-License-Identifier: MIT
"""Which arguments compiled code uses, from the compiler's own warnings.

Whatever is in doubt counts as used. What is used is read or written as the table says.
"""

from __future__ import annotations

import re

from usersub import abi
from usersub.routine.debuginfo import Signature
from usersub.routine.fortran_text import Unit
from usersub.routine.routine import READS, READS_AND_WRITES, UNUSED, WRITES

_DUMMY = re.compile(
    r"^([^\s:][^:]*):(\d+):\d+: Warning: Unused dummy argument '(\w+)'", re.MULTILINE
)
# A dummy list that was included instead of written out; its name tells the routine.
_LIST = re.compile(rf"(?:^|/)({'|'.join(abi.NAMES)})(?:_2022)?_names\.fi$")
_PARAMETER = re.compile(
    r"^([^\s:][^:]*):(\d+):(\d+): warning: unused parameter '(\w+)'", re.MULTILINE
)
# GCC: where the macro stands that the parameter of the warning before comes from.
_EXPANSION = re.compile(r"^[^\s:][^:]*:(\d+):(\d+): note: in expansion of macro '")
_DOES = {"read": READS, "write": WRITES, "readwrite": READS_AND_WRITES}


def unused_in_fortran(
    text: str, units: list[Unit], found: dict[str, Signature]
) -> dict[str, tuple[int, ...]]:
    """Unused positions by symbol, from the text of `gfortran -Wunused-dummy-argument`."""
    heads: dict[str, list[Unit]] = {}
    for unit in units:
        heads.setdefault(unit.file, []).append(unit)
    names: dict[str, set[str]] = {}
    for file, line, name in _DUMMY.findall(text):
        if listed := _LIST.search(file):
            names.setdefault(listed[1] + "_", set()).add(name.lower())
            continue
        # The innermost unit that begins at or before the line has the list of dummies.
        before = [u for u in heads.get(file, ()) if u.line <= int(line)]
        if before:
            names.setdefault(max(before, key=lambda u: u.line).name + "_", set()).add(name.lower())
    return {
        symbol: tuple(
            i for i, p in enumerate(signature.parameters) if p.name.lower() in names.get(symbol, ())
        )
        for symbol, signature in found.items()
    }


def unused_in_c(text: str, found: dict[str, Signature]) -> dict[str, tuple[int, ...]]:
    """Unused positions by symbol, from the text of `cc -Wunused-parameter`."""
    warned: list[tuple[int, int, str]] = []
    for line in text.splitlines():
        if parameter := _PARAMETER.match(line):
            warned.append((int(parameter[2]), int(parameter[3]), parameter[4]))
        elif warned and (macro := _EXPANSION.match(line)):
            # Debug information has the place where the macro is used.
            warned[-1] = (int(macro[1]), int(macro[2]), warned[-1][2])
    return {
        symbol: tuple(
            i
            for i, p in enumerate(signature.parameters)
            if not p.name or (p.line, p.column, p.name) in warned
        )
        for symbol, signature in found.items()
    }


def uses(face: abi.Interface, unused: tuple[int, ...] | None) -> tuple[int, ...] | None:
    """What a routine does with each argument; None if nothing is known."""
    if unused is None:
        return None
    return tuple(
        UNUSED if i in unused else _DOES[argument.intent] for i, argument in enumerate(face.args)
    )
