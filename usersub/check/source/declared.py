# SPDX-License-Identifier: MIT
"""How a Fortran routine declares its arguments, in the compiler's own words, names resolved."""

from __future__ import annotations

import re
from dataclasses import dataclass

from usersub.routine import fortran_text
from usersub.routine.fortran_text import Unit

_HEAD = re.compile(r"^procedure name = (?P<name>\w+)$")
_SYMBOL = re.compile(r"^\s*symtree: '(?P<name>[^']+)'")
_TYPE = re.compile(r"^\s*type spec\s*: \((?P<kind>\w+)(?: (?P<size>.*))?\)$")
_ARRAY = re.compile(
    r"^\s*Array spec:\((?P<rank>\d+)(?: \[\d+\])? AS_(?P<shape>\w+) ?(?P<bounds>.*)\)$"
)
_DUMMIES = re.compile(r"^\s*Formal arglist:(?P<names>.*)$")
_LENGTH = re.compile(r"^(?P<length>\d+)(?:_\d+)?\b")


@dataclass(frozen=True)
class Declared:
    """One variable of a program unit.

    Attributes:
        name: in lower case.
        kind: "REAL", "INTEGER", "CHARACTER", ... or "UNKNOWN".
        size: bytes of a number, or characters of a text; 0 if it is not fixed (`*(*)`).
        extents: of an array, outermost last: a number, the lower-case name of another argument,
            "*" (assumed size), ":" (assumed shape) or "?" (an expression); () for a scalar.
        implicit: whether the first letter of the name gave the type.
        dummy: whether it is an argument.
    """

    name: str
    kind: str = "UNKNOWN"
    size: int = 0
    extents: tuple[int | str, ...] = ()
    implicit: bool = False
    dummy: bool = False


@dataclass(frozen=True)
class DeclaredUnit:
    """A subroutine: the names of its `dummies` in their order, its `variables` by name."""

    name: str
    dummies: tuple[str, ...]
    variables: dict[str, Declared]


def units(dump: str) -> dict[str, DeclaredUnit]:
    """Procedures by lower-case name, from the text of `gfortran -fdump-fortran-original`.

    Interface bodies come before the procedure that they describe, so the last one of a name counts.
    """
    found: dict[str, DeclaredUnit] = {}
    name = ""
    lists: dict[str, tuple[str, ...]] = {}
    variables: dict[str, Declared] = {}
    for block in _symbols(dump):
        head = _HEAD.match(block[0].strip())
        if head:
            name = head["name"].lower()
            lists, variables = {}, {}
            continue
        one = _variable(block)
        variables[one.name] = one
        for line in block:
            if listed := _DUMMIES.match(line):
                lists[one.name] = tuple(listed["names"].split())
        if name in lists:
            found[name] = DeclaredUnit(name, lists[name], variables)
    return found


def _symbols(dump: str) -> list[list[str]]:
    """Lines that belong to one symbol, or the line with the name of a procedure."""
    blocks: list[list[str]] = []
    inside = False
    for line in dump.splitlines():
        if _HEAD.match(line.strip()):
            blocks.append([line])
            inside = False
        elif _SYMBOL.match(line):
            blocks.append([line])
            inside = True
        elif inside and line.strip():
            blocks[-1].append(line)
        else:
            inside = False
    return [b for b in blocks if _HEAD.match(b[0].strip()) or _SYMBOL.match(b[0])]


def _variable(block: list[str]) -> Declared:
    kind, size, attributes = "UNKNOWN", 0, ""
    extents: tuple[int | str, ...] = ()
    symbol = _SYMBOL.match(block[0])
    for line in block[1:]:
        if typed := _TYPE.match(line):
            kind = typed["kind"]
            length = _LENGTH.match(typed["size"] or "")
            size = int(length["length"]) if length else 0
        elif shaped := _ARRAY.match(line):
            extents = _extents(int(shaped["rank"]), shaped["shape"], shaped["bounds"])
        elif line.strip().startswith("attributes:"):
            attributes = line
    return Declared(
        symbol["name"].lower() if symbol else "",
        kind,
        size,
        extents,
        "IMPLICIT-TYPE" in attributes,
        " DUMMY" in attributes,
    )


def _extents(rank: int, shape: str, bounds: str) -> tuple[int | str, ...]:
    if shape in ("ASSUMED_SHAPE", "DEFERRED", "ASSUMED_RANK"):
        return (":",) * rank
    terms = _terms(bounds)
    pairs = list(zip(terms[::2], terms[1::2], strict=False))
    if len(pairs) != rank:
        return ("?",) * rank
    return tuple(_extent(low, high) for low, high in pairs)


def _terms(text: str) -> list[str]:
    """The blank-separated terms; what stands in parentheses is one term."""
    terms, depth, current = [], 0, ""
    for c in text + " ":
        depth += (c == "(") - (c == ")")
        if c == " " and depth == 0:
            if current:
                terms.append(current)
            current = ""
        else:
            current += c
    return terms


def _plain(term: str) -> int | str:
    """A number, a name without its unit, or "?"."""
    if number := re.fullmatch(r"(-?\d+)(?:_\d+)?", term):
        return int(number[1])
    if name := re.fullmatch(r"(?:\w+:)?([a-z]\w*)", term):
        return name[1]
    return "?"


def _extent(low: str, high: str) -> int | str:
    first, last = _plain(low), _plain(high)
    if high == "()":
        return "*"
    if isinstance(first, int) and isinstance(last, int):
        return last - first + 1
    if first == 1:
        return last
    # 0:N-1
    down = re.fullmatch(r"\(- (?:\w+:)?([a-z]\w*) 1(?:_\d+)?\)", high)
    return down[1] if first == 0 and down else "?"


_DECLARES = re.compile(
    r"^(dimension|integer|real|doubleprecision|complex|logical|character|byte|type\(|pointer)"
)


def place(unit: Unit, text: str, name: str, dimensions: bool) -> int:
    """Line of the declaration of `name` in a unit; 0 if there is none.

    Args:
        text: the text from which the unit was read.
        dimensions: look for one that gives it dimensions.
    """
    word = re.compile(
        rf"(?<![a-z0-9_]){name}(?![a-z0-9_])" + (r"\s*\(" if dimensions else ""), re.I
    )
    lines = fortran_text.lines_of(text)
    for statement in unit.statements[1:]:
        if not _DECLARES.match(statement.code) or re.match(r"^\w+(\([^)]*\))?=", statement.code):
            continue
        if not word.search(statement.text):
            continue
        for index in range(statement.last, -1, -1):
            if word.search(lines[index].partition("!")[0]):
                return max(statement.line, _number(lines, index))
    return 0


def _number(lines: list[str], index: int) -> int:
    """Line number in the user's file of a line of the prepared text."""
    for back in range(index, -1, -1):
        if marker := re.match(r'^#\s*(?:line\s+)?(\d+)\s+"', lines[back]):
            return int(marker[1]) + index - back - 1
    return index + 1
