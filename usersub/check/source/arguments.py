# SPDX-License-Identifier: MIT
"""The code of a subject as it was compiled, whether its routine could be made or not."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from usersub.check.rule import CannotCheck, NotApplicable
from usersub.check.source import again, declared
from usersub.errors import AbiError, CompileError, Error, LoadError, MissingTool
from usersub.routine import debuginfo, fortran_text
from usersub.routine.build import Build
from usersub.routine.loading import _language
from usersub.routine.native import Code

if TYPE_CHECKING:
    from usersub.check.source.again import Source
    from usersub.check.subject import Subject

SOURCES = ("c", "c++", "fortran")


def language(subject: Subject) -> str:
    """ "python", "c", "c++", "fortran", "library" or "pointer"."""
    if subject.file is not None:
        return subject.file.language
    if subject.path is not None:
        return _language(subject.path)
    return subject.routine.language if subject.routine is not None else "pointer"


def precision(subject: Subject) -> str:
    """The precision in which the subject's code is compiled."""
    known = subject.interface.precisions
    return subject.precision if subject.precision in known else known[0]


def build_of(subject: Subject) -> Build:
    """What is known of the compiled file.

    Raises:
        NotApplicable: it is a Python routine or a pointer.
        CannotCheck: it does not compile or link.
    """
    spoken = language(subject)
    if spoken == "python":
        raise NotApplicable("a Python routine names the arguments that it wants")
    if subject.file is None and subject.path is None:
        raise NotApplicable("the routine is a pointer, which says nothing of itself")
    try:
        if subject.file is not None and subject.file.code is not None:
            return subject.file.code.build(precision(subject))
        assert subject.path is not None
        return Code(subject.path, spoken, precision(subject)).build(precision(subject))
    except (LoadError, CompileError, MissingTool, AbiError) as error:
        raise CannotCheck(f"the file could not be compiled: {error}") from error


def signature_of(subject: Subject) -> debuginfo.Signature:
    """The argument list of the subject's routine.

    Raises:
        NotApplicable, CannotCheck: nothing is known of it.
    """
    build = build_of(subject)
    symbol = subject.interface.symbol
    found = build.signatures.get(symbol)
    if found is not None:
        return found
    if symbol not in build.functions:
        raise CannotCheck(
            f"{build.source.name} has no {subject.interface.name.upper()}; see symbols.entry"
        )
    if build.language == "library":
        raise CannotCheck("the library has no debug information; compile it with -g")
    raise CannotCheck("the compiler does not describe the arguments of a unit with ENTRY")


def unused_of(subject: Subject) -> frozenset[int]:
    """Positions of the arguments that the code does not use; empty where that is not known."""
    return frozenset(build_of(subject).unused.get(subject.interface.symbol, ()))


def source_of(subject: Subject) -> Source:
    """The subject's source, to be compiled again.

    Raises:
        NotApplicable: there is none.
        CannotCheck: no compiler, or it does not compile.
    """
    path = subject.path or (subject.file.path if subject.file is not None else None)
    spoken = language(subject)
    if path is None or spoken not in SOURCES:
        kind = {"library": "a library", "python": "a Python file"}.get(spoken, "a pointer")
        raise NotApplicable(f"{kind} has no source that a compiler reads")
    try:
        return again.of(path, precision(subject))
    except Error as error:
        raise CannotCheck(str(error)) from error


def unit_of(subject: Subject) -> declared.DeclaredUnit:
    """How the subject's routine declares its arguments (Fortran).

    Raises:
        NotApplicable: it is not in Fortran. CannotCheck: gfortran does not tell.
    """
    source = source_of(subject)
    if source.language != "fortran":
        raise NotApplicable("C passes addresses, which have no dimensions")
    try:
        found = declared.units(source.dump())
    except Error as error:
        raise CannotCheck(str(error)) from error
    unit = found.get(subject.interface.name)
    if unit is None:
        raise CannotCheck(f"gfortran describes no {subject.interface.name.upper()} in this file")
    return unit


def line_of_declaration(subject: Subject, name: str) -> str:
    """ "file:line" of the statement that gives the argument `name` its type or its dimensions, or
    "" if it has none in this file (Fortran)."""
    source = source_of(subject)
    file = source.path.name
    units = fortran_text.units(source.text(), source.free, file)
    own = [u for u in units if u.name == subject.interface.name and u.kind == "subroutine"]
    for dimensions in (True, False):
        for unit in own:
            if found := declared.place(unit, source.text(), name, dimensions):
                return f"{unit.file}:{found}"
    return ""


@dataclass(frozen=True)
class Outside:
    """A constant subscript beyond a dimension: argument, reference as written, place."""

    name: str
    text: str
    dimension: int
    most: int
    where: str


_OUTSIDE = re.compile(r"^Array reference is out of bounds \((\d+) > (\d+)\) in dimension (\d+)")


def subscripts_outside(subject: Subject, unit: declared.DeclaredUnit) -> Iterator[Outside]:
    """Constant subscripts of arguments beyond a dimension that is not the last (Fortran): the last
    says nothing of where elements lie, and is 1 in old code.

    Raises:
        CannotCheck: it does not compile.
    """
    source = source_of(subject)
    try:
        warned = source.warnings()
        lines = fortran_text.lines_of(source.path.read_bytes().decode("latin-1"))
    except (Error, OSError) as error:
        raise CannotCheck(str(error)) from error
    name, file = subject.interface.name, source.path.name
    units = [u for u in fortran_text.units(source.text(), source.free, file) if u.name == name]
    for warning in warned:
        said = _OUTSIDE.match(warning.words)
        own = file == warning.file and any(u.line <= warning.line <= u.end for u in units)
        if said is None or not own or warning.line > len(lines):
            continue
        index, most, dimension = map(int, said.groups())
        for found in re.finditer(r"(\w+)\s*\(([^()]*)\)", lines[warning.line - 1]):
            variable = unit.variables.get(found[1].lower())
            subscripts = [s.strip() for s in found[2].split(",")]
            if found[1].lower() not in unit.dummies or variable is None:
                continue
            if not dimension < len(variable.extents) == len(subscripts):
                continue
            if subscripts[dimension - 1] == str(index):
                yield Outside(found[1].lower(), found[0], dimension, most, warning.where)


def variant(subject: Subject, *options: str, text: str | None = None) -> Subject | None:
    """The subject compiled with more `options`, or from another `text`; None where that cannot be.

    Raises:
        NotApplicable: there is no source. CannotCheck: it does not compile as it is.
    """
    source, routine = source_of(subject), subject.routine
    if routine is None:
        return None
    try:
        entry = source.entry(*options, text=text, interface=subject.interface.name)
    except Error:
        return None
    if entry is None:
        return None
    return subject.but(routine=replace(routine, make_entry=lambda precision: entry))
