# SPDX-License-Identifier: MIT
"""Statements and program units of Fortran text, fixed and free form: as much as the build needs."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_DIRECTIVE = re.compile(r"^(?:[cC*!]|\s*!)(?:dec|dir)\$\s*(no)?(freeform|fixedform)\b", re.I)
_SENTINEL = re.compile(r"^(?:[cC*!]|\s*!)(?:\$|gcc\$)", re.I)
_DEBUG = re.compile(r"^[dD](?:[ \d]*\t|[ \d]{5})")
_MARKER = re.compile(r'^#\s*(?:line\s+)?(\d+)\s+"([^"]*)"')
_INCLUDE = re.compile(r"""^\s*(#\s*)?include\s*(['"<])\s*([^'">]+?)\s*['">]\s*(?:!.*)?$""", re.I)


@dataclass(frozen=True)
class Statement:
    """One statement: `text` in lower case without strings, comments and label; `code` the same
    without blanks; where it begins (`file`, `line`) and the index of its last line in the text."""

    text: str
    code: str
    file: str
    line: int
    last: int


@dataclass
class Unit:
    """A program unit or a procedure in it: `statements` are its own, not those of inner units."""

    kind: str
    name: str
    file: str
    line: int
    end: int = 0
    statements: list[Statement] = field(default_factory=list)


def lines_of(text: str) -> list[str]:
    """The lines of a text. Only a line feed ends one: other encodings have letters where
    `str.splitlines` sees line ends."""
    return text.removesuffix("\n").split("\n")


def is_free(suffix: str, text: str) -> bool:
    """Form of a source by its suffix, or by a `!DEC$ FREEFORM` that stands in it."""
    for line in lines_of(text):
        found = _DIRECTIVE.match(line)
        if found:
            return (found[2].lower() == "freeform") != bool(found[1])
    return suffix.lower() in (".f90", ".f95", ".f03", ".f08", ".f18")


def include_of(line: str) -> str | None:
    """The file that an INCLUDE line or `#include` names, or None."""
    found = _INCLUDE.match(line)
    return found[3] if found else None


def is_comment(line: str, free: bool) -> bool:
    """Whether the line is a comment that no compiler reads (directives are not)."""
    if _SENTINEL.match(line):
        return False
    if line.lstrip().startswith("!"):
        # A mark in column 6 of fixed form continues the line before.
        return free or line.index("!") != 5
    # `D` in column 1 marks lines for debugging only.
    return not free and (line[:1] in ("c", "C", "*") or bool(_DEBUG.match(line)))


def statements(text: str, free: bool, file: str) -> Iterator[Statement]:
    """The statements of `text`; `# line "file"` markers count."""
    parts: list[str] = []
    begin, last = (file, 1), 0
    number, continued = 0, False
    for index, line in enumerate(lines_of(text)):
        number += 1
        marker = _MARKER.match(line)
        if marker:
            number, file = int(marker[1]) - 1, marker[2]
            continue
        if line.startswith("#") or is_comment(line, free) or not line.strip():
            continue
        if _SENTINEL.match(line):
            continue
        joins, body = _free_line(line, continued) if free else _fixed_line(line)
        if not joins and parts:
            yield from _split(parts, begin, last)
            parts = []
        if not parts:
            begin = (file, number)
        body = _bare(body)
        continued = free and body.rstrip().endswith("&")
        parts.append(body.rstrip().removesuffix("&") if free else body)
        last = index
    if parts:
        yield from _split(parts, begin, last)


def _fixed_line(line: str) -> tuple[bool, str]:
    """(is a continuation, statement field) of a fixed-form line, tab form included."""
    head, tab, rest = line[:6].partition("\t")
    if tab:
        rest += line[6:]
        if rest[:1] in "123456789" and rest and not head.strip():
            return True, rest[1:]
        return False, rest
    return line[5:6] not in ("", " ", "0") and not line[:5].strip(), line[6:132]


def _free_line(line: str, continued: bool) -> tuple[bool, str]:
    body = line.lstrip()
    if continued and body.startswith("&"):
        body = body[1:]
    return continued, re.sub(r"^\s*\d+\s", "", body)


def _bare(body: str) -> str:
    """The line without texts and comment: quotes are kept, what is between them is not."""
    kept, quote = [], ""
    for c in body:
        if quote:
            if c == quote:
                quote = ""
                kept.append(c)
        elif c in "'\"":
            quote = c
            kept.append(c)
        elif c == "!":
            break
        else:
            kept.append(c)
    return "".join(kept)


def _split(parts: list[str], begin: tuple[str, int], last: int) -> Iterator[Statement]:
    for piece in "".join(parts).lower().split(";"):
        code = "".join(piece.split())
        if code:
            yield Statement(" ".join(piece.split()), code, *begin, last)


_PREFIX = (
    r"(?:recursive|pure|elemental|impure|module|non_recursive|doubleprecision|doublecomplex|byte"
    r"|(?:integer|real|complex|logical|character|type|class)(?:\*\d+|\*\(\*\)|\([^()]*\))?)*"
)
_PROCEDURE = re.compile(rf"^{_PREFIX}(subroutine|function)([a-z]\w*)(\(.*|bind\(.*|$)")
_OTHER = re.compile(r"^(program|blockdata|submodule\([\w:]+\)|module)(\w*)$")
_END = re.compile(
    r"^end(?:(?:subroutine|function|program|submodule|module|blockdata|procedure)\w*)?$"
)
_INTERFACE = re.compile(r"^(?:abstract)?interface(?:\w*|(?:operator|assignment|read|write)\(.*\))$")
_TYPED = re.compile(
    r"^(integer|real|doubleprecision|complex|logical|character|byte|type\(|procedure\()"
)


def _opens(statement: Statement) -> tuple[str, str] | None:
    """(kind, name) of the program unit that this statement begins, or None."""
    found = _PROCEDURE.match(statement.code)
    # `INTEGER FUNCTIONS(3)` declares an array.
    word = found and (found[1] == "subroutine" or re.search(r"\bfunction\b", statement.text))
    if found and word and not _is_assignment(found[3]):
        return found[1], found[2]
    found = _OTHER.match(statement.code)
    if found and not found[2].startswith("procedure") and (found[2] or found[1] == "blockdata"):
        return found[1].split("(")[0], found[2]
    return None


def _is_assignment(rest: str) -> bool:
    """Whether what follows a name is `(i) = value` and not an argument list."""
    depth = 0
    for i, c in enumerate(rest):
        depth += (c == "(") - (c == ")")
        if depth == 0:
            return rest[i + 1 : i + 2] == "="
    return False


def units(text: str, free: bool, file: str) -> list[Unit]:
    """Program units in the order in which they begin, inner procedures included.

    Interface bodies are statements of the unit around them.
    """
    found: list[Unit] = []
    open_units: list[Unit] = []
    interfaces = 0
    for statement in statements(text, free, file):
        opened = None if interfaces else _opens(statement)
        if opened:
            unit = Unit(*opened, statement.file, statement.line)
            found.append(unit)
            open_units.append(unit)
        if open_units:
            open_units[-1].statements.append(statement)
            open_units[-1].end = max(open_units[-1].end, statement.line)
        if statement.code.startswith("endinterface"):
            interfaces = max(0, interfaces - 1)
        elif _INTERFACE.match(statement.code) and open_units:
            interfaces += 1
        elif not interfaces and _END.match(statement.code) and open_units:
            open_units.pop()
    return found


def uses(unit: Unit, name: str) -> bool:
    """Whether the unit calls the function `name`."""
    call = re.compile(rf"\b{re.escape(name.lower())}\s*\(")
    return any(call.search(s.text) and not _TYPED.match(s.code) for s in unit.statements)


def declares(unit: Unit, name: str) -> bool:
    """Whether the unit itself gives the function `name` a type (a bare EXTERNAL does not)."""
    word = re.compile(rf"(?<![a-z0-9_]){re.escape(name.lower())}(?![a-z0-9_])")
    body = re.compile(rf"function{re.escape(name.lower())}\(")
    for statement in unit.statements[1:]:
        typed = _TYPED.match(statement.code) and not re.match(r"^[a-z]\w*=", statement.code)
        if typed and word.search(statement.text):
            return True
        if body.search(statement.code):
            return True
    return False


def place_for_declarations(unit: Unit) -> int:
    """Index of the line after which declarations may stand: behind the head of the unit, USE,
    IMPORT and IMPLICIT."""
    heads = (s for s in unit.statements[1:] if re.match(r"^(use[a-z,:]|import|implicit)", s.code))
    typing = [s.last for s in heads if not re.match(r"^\w+=[^>]", s.code)]
    return max([unit.statements[0].last, *typing])


def owner(found: list[Unit], index: int) -> Unit | None:
    """The unit to which a line without a statement (an INCLUDE) belongs."""
    before = [(s.last, unit) for unit in found for s in unit.statements if s.last < index]
    return max(before, key=lambda pair: pair[0])[1] if before else None
