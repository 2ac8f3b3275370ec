# SPDX-License-Identifier: MIT
"""What published Fortran gets away with elsewhere and gfortran refuses, mended in the build copy.

Line numbers stay those of the file. Nothing here changes a file that gfortran takes as it is.
"""

from __future__ import annotations

import re

from usersub.routine.fortran_text import Unit, owner

#: Modules of another compiler whose functions (SYSTEM, SLEEP, RAND ...) gfortran knows by itself.
_VENDOR_MODULES = ("ifport", "ifposix", "ifcore", "dfport", "dflib")
_USE_LINE = re.compile(rf"^(\s*\d*\s*)use\s*(?:{'|'.join(_VENDOR_MODULES)})\s*(?:,[^;]*)?$", re.I)
_USE = re.compile(r"^use(?:,(?:non_)?intrinsic)?(?:::)?([a-z]\w*)")
_NO_TYPING = re.compile(r"implicit\s+none(?:\s*\([\w\s,]*\))?", re.I)
_OWN_TYPING = re.compile(r"^implicit(?:real|doubleprecision)\S*\(a-h,o-z\)$")


def quiet_comment(line: str) -> str:
    """The line without what the preprocessor would see in a comment behind code: `/*`, and a
    backslash at the end."""
    if "!" not in line or not ("/*" in line or line.rstrip().endswith("\\")):
        return line
    quote = ""
    for at, c in enumerate(line):
        if quote:
            quote = "" if c == quote else quote
        elif c in "'\"":
            quote = c
        # A mark in column 6 of fixed form continues a line.
        elif c == "!" and (at != 5 or line[:5].strip()):
            return line[:at] + line[at:].replace("/*", "/ ").rstrip().rstrip("\\")
    return line


def modules_first(found: list[Unit], count: int) -> list[int] | None:
    """Order of the `count` lines with modules before the units that use them; None if they are in
    order."""
    modules = {unit.name: unit for unit in found if unit.kind == "module"}
    begun: set[str] = set()
    late = False
    used: dict[str, list[str]] = {name: [] for name in modules}
    inside = ""
    for unit in found:
        if unit.kind == "module":
            inside = unit.name
            begun.add(inside)
        elif inside and unit.line > modules[inside].statements[-1].last:
            inside = ""
        for statement in unit.statements:
            use = _USE.match(statement.code)
            if use and use[1] in modules:
                late = late or use[1] not in begun
                if inside:
                    used[inside].append(use[1])
    if not late:
        return None
    front: list[str] = []

    def place(name: str, above: tuple[str, ...] = ()) -> None:
        for other in used[name]:
            if other not in above:
                place(other, (*above, name))
        if name not in front:
            front.append(name)

    for name in modules:
        place(name)
    moved = [
        index
        for name in front
        for index in range(modules[name].line - 1, modules[name].statements[-1].last + 1)
    ]
    return [*moved, *sorted(set(range(count)) - set(moved))]


def without_vendor_modules(lines: list[str], found: list[Unit]) -> None:
    """Blanks `USE IFPORT` and its like in `lines`, unless the file has a module of that name."""
    own = {unit.name for unit in found if unit.kind == "module"}
    for unit in found:
        for statement in unit.statements:
            use = _USE.match(statement.code)
            if use and use[1] in _VENDOR_MODULES and use[1] not in own:
                index = statement.line - 1
                if index == statement.last and _USE_LINE.match(lines[index].partition("!")[0]):
                    lines[index] = ""


def without_double_typing(lines: list[str], found: list[Unit], includes: list[int]) -> None:
    """Blanks IMPLICIT NONE, and a second rule for all reals, in units with an include file that
    sets the typing rule; gfortran takes one rule only.

    Args:
        lines: changed in place.
        includes: indices of the lines that include a typing rule.
    """
    typed = [unit for i in includes if (unit := owner(found, i)) is not None]
    for unit in found:
        if not any(unit is other for other in typed):
            continue
        for statement in unit.statements[1:]:
            index = statement.line - 1
            if statement.code.startswith("implicitnone"):
                lines[index] = _NO_TYPING.sub("", lines[index])
            elif _OWN_TYPING.match(statement.code) and index == statement.last:
                lines[index] = ""
