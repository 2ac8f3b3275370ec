# SPDX-License-Identifier: MIT
"""Memory of the routine itself: local arrays on the stack, and blocks of the heap."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing import heap
from usersub.check.probing.watching import watch
from usersub.check.respond import respond
from usersub.check.rule import CannotCheck, Finding, rule
from usersub.check.rules.words import failed
from usersub.check.source import again
from usersub.check.source.declared import units
from usersub.check.subject import Subject
from usersub.errors import CompileError, Error, LoadError
from usersub.routine import objects
from usersub.routine.routine import Entry

_COMPILED = ("c", "c++", "fortran")

#: What libgfortran says of an index outside of its array.
_INDEX = re.compile(r"Index '(-?\d+)' of dimension (\d+) of array '(\w+)' (above|below)")
_LINE = re.compile(r"line (\d+)")
#: Builds that look at the bounds of arrays whose sizes the compiler knows.
_C_BOUNDS = ("-fstack-protector-all", "-fsanitize=bounds", "-fsanitize-undefined-trap-on-error")
_FORTRAN_BOUNDS = ("-fstack-protector-all", "-fcheck=bounds")

_STACK_HINT = "compare the dimensions of local arrays with the indices that reach them"
_HEAP_HINT = "compare the sizes of allocations with the indices that reach them"


@rule(
    "memory.stack",
    "The routine stays within its local arrays and its stack.",
    reference="a damaged stack returns to nowhere, or to a wrong result",
)
def stack(subject: Subject) -> Iterator[Finding]:
    """Overflow as it is; local arrays in a build that looks at them."""
    for case in cases.common(subject):
        told = failed(subject.respond(case, enforced=True))
        if "stack overflow" in told:
            yield Finding(told, case, hint="make large local arrays static or allocatable")
            return
    if subject.routine is None or subject.routine.language not in _COMPILED:
        return
    fortran = subject.routine.language == "fortran"
    locals_of = _locals(subject) if fortran else frozenset[str]()
    guarded = _variant(subject, *(_FORTRAN_BOUNDS if fortran else _C_BOUNDS))
    if guarded is None:
        raise CannotCheck("the source cannot be compiled again with bounds")
    for case in cases.common(subject):
        told = failed(respond(guarded, case, enforced=True))
        found = _array_fault(told, locals_of, subject)
        if found is None and told and not failed(subject.respond(case, enforced=True)):
            found = _trapped(guarded, case, told)
        if found is not None:
            yield replace(found, case=case)
            return


@rule(
    "memory.heap",
    "The routine stays within the memory that it allocates, and frees it once.",
    reference="a damaged heap ends the host later, elsewhere",
    languages=_COMPILED,
    seconds=15.0,
)
def blocks(subject: Subject) -> Iterator[Finding]:
    """A build whose allocations end at a page that nobody may touch."""
    called = _called(subject) & set(heap.RENAMED)
    if not called:
        return
    guarded = _variant(subject, renamed={name: heap.RENAMED[name] for name in called})
    if guarded is None:
        raise CannotCheck("the source cannot be compiled again with another heap")
    for case in cases.common(subject):
        before = heap.live()
        told = failed(respond(guarded, case, enforced=True))
        detail = heap.explain(told)
        if detail:
            yield Finding(detail, case, hint=_HEAP_HINT)
            return
        grown = heap.live() - before
        if not told and grown > len(case.steps) * case.points // 2 > 1:
            again_grown = _growth(guarded, case)
            if again_grown >= grown:
                yield Finding(
                    f"{again_grown} blocks of memory are allocated and never freed in "
                    f"{len(case.steps)} increments of {case.points} points",
                    case,
                    hint="free in every call what the call allocates",
                )
                return


def _trapped(guarded: Subject, case: Case, told: str) -> Finding | None:
    """What the traps of a build with bounds caught, where the usual build goes on."""
    if "abort" in told:
        detail = "a local array is written beyond its end: the stack around it is damaged"
    elif "saw coming" in told or "illegal instruction" in told:
        detail = "an array of the routine's own is used at an index outside of its bounds"
    else:
        return None
    seen = watch(guarded, case, ("crash",))
    options = " ".join(_C_BOUNDS[:2])
    where = seen.where if seen is not None else ""
    return Finding(f"{detail} (seen in a build with {options})", where=where, hint=_STACK_HINT)


def _called(subject: Subject) -> set[str]:
    """Functions of others that the compiled file calls."""
    if subject.file is None or subject.file.code is None:
        return set()
    return set(objects.read(subject.file.code.build(subject.precision).library).missing)


def _growth(subject: Subject, case: Case) -> int:
    before = heap.live()
    respond(subject, case, enforced=True)
    return heap.live() - before


def _variant(subject: Subject, *options: str, **more: dict[str, str]) -> Subject | None:
    """The subject compiled in another way; None where that cannot be."""
    routine, name = subject.routine, subject.interface.name
    if routine is None or subject.path is None or routine.language not in _COMPILED:
        return None
    try:
        source = again.of(subject.path, subject.precision)
        made = source.entry(*options, interface=name, **more)  # type: ignore[arg-type]
    except Error:
        return None
    if made is None:
        return None
    entry: Entry = made
    return subject.but(routine=replace(routine, make_entry=lambda precision: entry))


def _locals(subject: Subject) -> frozenset[str]:
    """Lower-case names of arrays that are the routine's own."""
    assert subject.path is not None
    try:
        found = units(again.of(subject.path, subject.precision).dump())
    except (CompileError, LoadError):
        return frozenset()
    unit = found.get(subject.interface.name)
    if unit is None:
        return frozenset()
    # Pointers and allocatable arrays are not on the stack; there may be nothing behind them yet.
    return frozenset(
        v.name
        for v in unit.variables.values()
        if v.extents and ":" not in v.extents and not v.dummy
    )


def _array_fault(told: str, names: frozenset[str], subject: Subject) -> Finding | None:
    """What the bounds check of gfortran said, if it is about a local array."""
    found = _INDEX.search(told)
    if found is None or found[3].lower() not in names:
        return None
    line = _LINE.search(told)
    where = f"{subject.path.name}:{line[1]}" if line and subject.path is not None else ""
    beyond = "above its upper" if found[4] == "above" else "below its lower"
    return Finding(
        f"the local array {found[3]} is used at index {found[1]} of dimension {found[2]}, "
        f"{beyond} bound",
        where=where,
        hint=_STACK_HINT,
    )
