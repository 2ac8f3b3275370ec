# SPDX-License-Identifier: MIT
"""Variables of a compiled routine that outlive a call: COMMON, SAVE, module and static data."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from usersub.check.rule import CannotCheck, NotApplicable
from usersub.check.source import arguments
from usersub.errors import Error
from usersub.routine import debuginfo, objects

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: One section a function and a variable; arrays that gfortran would make static for their size
#: alone stay local, as they are for the solver's compiler.
_SECTIONS = ("-ffunction-sections", "-fdata-sections")
_LOCAL_ARRAYS = "-frecursive"


@dataclass(frozen=True)
class Static:
    """A variable that outlives a call: its name for people, its bytes (0 if not known), "file:line"
    of its declaration or ""."""

    people: str
    size: int
    where: str


def of_routine(subject: Subject) -> list[Static]:
    """Writable variables that the subject's routine can come to touch.

    Raises:
        NotApplicable: it is a Python routine or a pointer. CannotCheck: it does not compile.
    """
    return _found(subject, [subject.interface.symbol])


def of_file(subject: Subject) -> list[Static]:
    """Writable variables of the whole file; raises as `of_routine`."""
    return _found(subject, None)


def _found(subject: Subject, start: list[str] | None) -> list[Static]:
    try:
        source = arguments.source_of(subject)
    except NotApplicable:
        return _of_library(subject)
    more = (_LOCAL_ARRAYS,) if source.language == "fortran" else ()
    try:
        path = source.object(*_SECTIONS, *more)
    except Error as error:
        raise CannotCheck(str(error)) from error
    if not objects.is_elf(path):
        raise CannotCheck("the object file is not in ELF, the only form that is read")
    found = objects.kept_by(path, start)
    places = debuginfo.variables(path) if found else {}  # slower than all else here
    return [
        Static(kept.people, kept.size, places.get(_own_name(kept.people), "")) for kept in found
    ]


def _own_name(people: str) -> str:
    """`COMMON /BLK/` -> blk, `module variable M::X` -> x, `variable count` -> count."""
    return people.split()[-1].rpartition("::")[2].strip("/").lower()


def _of_library(subject: Subject) -> list[Static]:
    build = arguments.build_of(subject)
    sizes: dict[str, int] = {}
    if objects.is_elf(build.library):
        sizes = {kept.people: kept.size for kept in objects.kept_by(build.library)}
    return [Static(name, sizes.get(name, 0), "") for name in build.shared]


def in_words(statics: list[Static], most: int = 4) -> str:
    """Names and sizes, the largest first."""

    def each() -> Iterator[str]:
        for static in sorted(statics, key=lambda s: -s.size)[:most]:
            told = not static.size or "bytes" in static.people
            yield static.people + ("" if told else f" ({bytes_in_words(static.size)})")
        if len(statics) > most:
            yield f"{len(statics) - most} more"

    listed = list(each())
    return listed[0] if len(listed) == 1 else ", ".join(listed[:-1]) + " and " + listed[-1]


def bytes_in_words(count: int) -> str:
    """A number of bytes, rounded to three digits."""
    for unit, size in (("GiB", 1 << 30), ("MiB", 1 << 20), ("KiB", 1 << 10)):
        if count >= size:
            return f"{count / size:.3g} {unit}"
    return f"{count} bytes"
