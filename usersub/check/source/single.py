# SPDX-License-Identifier: MIT
"""Where a source in double precision uses single precision or integers, from the compiler."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.source import declared
from usersub.routine import fortran_text
from usersub.routine.fortran_text import Unit

if TYPE_CHECKING:
    from usersub.check.source.again import Source, Warned

#: Options of gfortran and GCC for conversions that lose something.
FORTRAN = ("-Wconversion", "-Wconversion-extra", "-Winteger-division", "-fsyntax-only")
C = ("-Wfloat-conversion", "-Wdouble-promotion", "-Wabsolute-value", "-fsyntax-only")
#: All reals of single precision in double precision.
PROMOTED = ("-freal-4-real-8",)

_MATHS = (
    "sqrt|fabs|exp|exp2|expm1|log|log1p|log10|log2|pow|tanh|sinh|cosh|sin|cos|tan|atan2?|asin|acos"
    "|hypot|fmin|fmax|floor|ceil|cbrt|fmod|copysign|round|trunc|erf|atanh|asinh|acosh"
)

_LITERAL = re.compile(r"(?<![\w.])(?:\d+\.\d*|\.\d+|\d+(?=e))(?:e[+-]?\d+)?(?![\w.])", re.I)
_ASSIGNED = re.compile(r"^[\s\d]*(?:\S.*\)\s*)??([a-z]\w*)\s*=[^=]", re.I)
#: Names that people give to what is no whole number, among those that Fortran takes for integers.
_REAL_NAMES = re.compile(
    r"^(?:mu(?!lt|x)\w*|nu\d?|lambda\w*|kappa\w*|mass\w*|load\w*|length\w*|normal\w*|limit\w*"
    r"|kstick\w*|kstiff\w*|kelas\w*)$"
)


_SINGLE = re.compile(r"type spec\s*: \(REAL 4\)|_r4\b|_4_r8|_gfortran_(?:float|sngl|real)\b")


def has_single(source: Source) -> bool:
    """Whether anything but constants has single precision (Fortran)."""
    return bool(_SINGLE.search(source.dump()))


@dataclass(frozen=True)
class Constant:
    """A constant in single precision that is not exact: as written, where, its relative error."""

    text: str
    where: str
    error: float


def constants(source: Source, warned: list[Warned]) -> list[Constant]:
    """Inexact constants of single precision in expressions of double precision (Fortran)."""
    lines = _lines(source)
    wheres = [w for w in warned if "'REAL(4)' to 'REAL(8)'" in w.words]
    found = []
    for w in dict.fromkeys((w.file, w.line) for w in wheres):
        code = _TEXT.sub("''", lines.get(w, "")).partition("!")[0]
        for literal in _LITERAL.finditer(code):
            value = float(literal[0].lower())
            error = abs(float(np.float32(value)) - value) / value if value else 0.0
            if error > 0 and not _is_guard(value):
                found.append(Constant(literal[0], f"{w[0]}:{w[1]}", error))
    return list(dict.fromkeys(found))


_TEXT = re.compile(r"'[^']*'|\"[^\"]*\"")


def constants_of_c(source: Source) -> list[Constant]:
    """Inexact constants of type float in a C or C++ file itself."""
    try:
        text = source.path.read_text(encoding="latin-1")
    except OSError:
        return []
    found = []
    for number, line in enumerate(without_comments(text).split("\n"), 1):
        for literal in _FLOAT_LITERAL.finditer(line):
            value = float(literal[1])
            error = abs(float(np.float32(value)) - value) / value if value else 0.0
            if error > 0 and not _is_guard(value):
                found.append(Constant(literal[0], f"{source.path.name}:{number}", error))
    return found


_FLOAT_LITERAL = re.compile(r"(?<![\w.])((?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?)[fF]\b")
_COMMENT = re.compile(r'"(?:[^"\\\n]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def without_comments(text: str) -> str:
    """C text with comments and strings blanked, line by line."""
    return _COMMENT.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def _is_guard(value: float) -> bool:
    """Powers of ten far from one: tolerances, of which no digit matters."""
    power = float(np.log10(value)) if 0 < value < np.inf else 0.0
    return abs(power) >= 5 and abs(power - round(power)) < 1e-12


def _lines(source: Source) -> dict[tuple[str, int], str]:
    """Lines of what the compiler reads, by file and number."""
    lines = fortran_text.lines_of(source.text())
    found: dict[tuple[str, int], str] = {}
    for index, file, number in _numbered(lines, source.path.name):
        found.setdefault((file, number), lines[index])
    return found


def narrowed(warned: list[Warned]) -> list[Warned]:
    """Where values of double precision are stored in single precision, or come from there."""
    return [w for w in warned if _NARROWED.search(w.words) or w.option == "-Wdouble-promotion"]


_NARROWED = re.compile(
    r"from REAL\(8\) to REAL\(4\)|from '[^']*double[^']*'.* to '[^']*float[^']*'"
)
_TO_WHOLE = re.compile(
    r"from REAL\(\d+\) to INTEGER\(\d+\)"
    r"|from '[^']*(?:double|float|real)[^']*'.* to '[^']*(?:int|long|short)[^']*'"
)


def whole(warned: list[Warned]) -> list[Warned]:
    """Where real values are assigned to integers without a word."""
    return [w for w in warned if _TO_WHOLE.search(w.words)]


def of_routine(source: Source, name: str, warned: list[Warned]) -> list[Warned]:
    """Warnings in the program unit `name` and in what it comes to call (Fortran); other languages:
    all of them."""
    if source.language != "fortran":
        return warned
    units = fortran_text.units(source.text(), source.free, source.path.name)
    if name not in {u.name for u in units}:
        return warned
    words = {
        id(u): {word for s in u.statements[1:] for word in re.findall(r"[a-z]\w*", s.text)}
        for u in units
    }
    reached: set[int] = set()
    todo = [u for u in units if u.name == name]
    while todo:
        unit = todo.pop()
        if id(unit) not in reached:
            reached.add(id(unit))
            todo += [u for u in units if u.name in words[id(unit)]]
    return [w for w in warned if _owner(units, w) is None or id(_owner(units, w)) in reached]


def _owner(units: list[Unit], warned: Warned) -> Unit | None:
    """The innermost unit that a warning is in; None for lines of included files."""
    around = [u for u in units if u.file == warned.file and u.line <= warned.line <= u.end]
    return max(around, key=lambda u: u.line) if around else None


def mentions(source: Source) -> list[str]:
    """Lines ("file:line") of the file itself that ask for single precision in so many words."""
    try:
        text = source.path.read_text(encoding="latin-1")
    except OSError:
        return []
    if source.language != "fortran":
        text = without_comments(text)
    name, words = source.path.name, _WORDS[source.language == "fortran"]
    return [f"{name}:{n}" for n, line in enumerate(text.split("\n"), 1) if words.search(line)]


_WORDS = (
    re.compile(rf"\bfloat\b|\b(?:{_MATHS})f\s*\("),
    re.compile(r"^[^!]*(?:\breal\s*\*\s*4|\breal\(\s*4|\bsngl\s*\(|\breal32\b)", re.I),
)


def divisions(warned: list[Warned]) -> list[Warned]:
    """Divisions of whole constants that cut off what is behind the point."""
    return [w for w in warned if w.option == "-Winteger-division"]


@dataclass(frozen=True)
class Cut:
    """An integer by its first letter alone that gets real values: name, program unit, where, and
    whether people call real quantities so."""

    name: str
    unit: str
    where: str
    real_name: bool


def cut(source: Source, warned: list[Warned]) -> list[Cut]:
    """Integers without a declaration to which real values are assigned (Fortran)."""
    units = declared.units(source.dump())
    lines = _lines(source)
    heads = fortran_text.units(source.text(), source.free, source.path.name)
    found = []
    for w in warned:
        if not re.search(r"conversion from REAL\(\d+\) to INTEGER\(4\)", w.words):
            continue
        assigned = re.match(
            r"^[\s\d]*(?:\S.*\)\s*)??([a-z]\w*)\s*=[^=]", lines.get((w.file, w.line), ""), re.I
        )
        before = [u for u in heads if u.file == w.file and u.line <= w.line]
        if not assigned or not before:
            continue
        unit, name = max(before, key=lambda u: u.line).name, assigned[1].lower()
        known = units[unit].variables.get(name) if unit in units else None
        if known is None or not known.implicit or known.kind != "INTEGER" or known.dummy:
            continue
        found.append(Cut(name, unit, w.where, bool(_REAL_NAMES.match(name))))
    return list({c.name: c for c in reversed(found)}.values())[::-1]


def with_real(source: Source, one: Cut) -> str | None:
    """The text in which the variable is declared REAL*8; None if the unit is not found."""
    text = source.text()
    lines = fortran_text.lines_of(text)
    for unit in fortran_text.units(text, source.free, source.path.name):
        if unit.name != one.unit:
            continue
        # Behind an INCLUDE that sets the typing rule, before the first statement of its own.
        place = fortran_text.place_for_declarations(unit)
        following = [
            s for s in unit.statements if s.last > place and not s.code.startswith("include")
        ]
        if not following:
            return None
        at = _index_of(lines, source.path.name, following[0].file, following[0].line)
        own = [f"      real*8 {one.name}", f'# {following[0].line} "{following[0].file}"']
        return "\n".join([*lines[:at], *own, *lines[at:]]) + "\n"
    return None


def _numbered(lines: list[str], file: str) -> Iterator[tuple[int, str, int]]:
    """Index, file and number of every line that is no marker."""
    number = 0
    for index, line in enumerate(lines):
        marker = re.match(r'^#\s*(?:line\s+)?(\d+)\s+"([^"]*)"', line)
        if marker:
            file, number = marker[2], int(marker[1]) - 1
        else:
            number += 1
            yield index, file, number


def _index_of(lines: list[str], main: str, file: str, number: int) -> int:
    """Index of a line of the user's file; that of the end if it is not there."""
    places = ((f, n, i) for i, f, n in _numbered(lines, main))
    return next((i for f, n, i in places if (f, n) == (file, number)), len(lines))


# C.

_FLOAT = (
    (re.compile(r"\bfloat\b"), "double"),
    (re.compile(r"(?<![\w.])((?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)[fF]\b"), r"\1"),
    (re.compile(rf"\b({_MATHS})f(?=\s*\()"), r"\1"),
)
_MARKER = re.compile(r'^# \d+ "[^"]*"(?P<flags>[ \d]*)$')


def promoted_c(text: str) -> str:
    """The preprocessed text with double for float in all that is not of the system."""
    made, system = [], False
    for line in text.split("\n"):
        marker = _MARKER.match(line)
        if marker:
            system = "3" in marker["flags"].split()
        elif not system:
            for pattern, other in _FLOAT:
                line = pattern.sub(other, line)
        made.append(line)
    return "\n".join(made)


def real_abs(text: str, warned: list[Warned], file: str) -> str:
    """The text with fabs for abs in the lines where the compiler saw abs of a real number."""
    wrong = {(w.file, w.line) for w in warned if w.option == "-Wabsolute-value"}
    lines = text.split("\n")
    for index, place, number in _numbered(lines, file):
        if (place, number) in wrong:
            lines[index] = re.sub(r"\babs(?=\s*\()", "__builtin_fabs", lines[index])
    return "\n".join(lines)
