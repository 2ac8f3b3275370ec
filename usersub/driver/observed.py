# SPDX-License-Identifier: MIT
"""What a checked driver saw in its last call."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub.core import ffi, lib, text
from usersub.errors import RoutineError

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Kinds of faults, in the order of USUB_SAW_... of the C core.
KINDS = (
    "nothing",
    "outside",
    "input written",
    "left out",
    "not written",
    "output read",
    "uninitialised",
    "not repeated",
    "crash",
    "stop",
    "time",
    "red zone",
)

_ACCESS = ("", "read", "written")
_FLAGS = ("invalid", "division by zero", "overflow", "underflow")


@dataclass(frozen=True)
class Observed:
    """What the last call of a checked driver saw.

    Attributes:
        what: one of `KINDS`: "nothing"; "outside" an element that an argument does not have was
            read or written; "input written"; "left out" an argument that the routine is said not to
            use was touched; "not written" an output that a host cannot do without; "output read"
            before it was written; "uninitialised" a local variable was read before it was set; "not
            repeated" the same input gave another answer; "crash" a signal that no argument
            explains; "stop" the routine ended the program; "time" it did not return in time; "red
            zone" memory beside an argument was written, found after the call.
        argument: the argument, newer spelling; "" if it is about none.
        element: element of the argument from 0 in the order of memory, may lie outside; or None.
        index: the same in Fortran's indices, from 1; () for an argument that is one number.
        access: "read", "written" or "".
        point: contact point from 0, or None if it is not known.
        flags: floating-point exceptions of all points; compilers raise some that the source does
            not, so that they are hints.
        unwritten: outputs that some call of the routine left as they were, wholly or in part.
        read: arguments that were read before they were written, if the driver traces.
        written: arguments that were written, likewise.
        where: "file:line" of the source, or "".
        sentence: the fault in words, without point and place; "" if there is none.
    """

    what: str = "nothing"
    argument: str = ""
    element: int | None = None
    index: tuple[int, ...] | None = None
    access: str = ""
    point: int | None = None
    flags: tuple[str, ...] = ()
    unwritten: frozenset[str] = frozenset()
    read: frozenset[str] = frozenset()
    written: frozenset[str] = frozenset()
    where: str = ""
    sentence: str = ""
    place: int = field(default=0, repr=False)


def observe(handle: Any, routine: Routine, where: str = "") -> Observed:
    """What the driver behind `handle` saw; `where` stands in where no instruction is known."""
    seen = ffi.new("usub_observed *")
    lib.usub_get_observed(handle, seen)
    names = [arg.modern for arg in routine.interface.args]
    about = seen.argument >= 0

    def named(bits: int) -> frozenset[str]:
        return frozenset(name for i, name in enumerate(names) if bits >> i & 1)

    return Observed(
        what=KINDS[seen.what],
        argument=names[seen.argument] if about else "",
        element=seen.element if about else None,
        index=tuple(seen.index[0 : seen.rank]) if about else None,
        access=_ACCESS[seen.access],
        point=seen.point if seen.point >= 0 else None,
        flags=tuple(flag for i, flag in enumerate(_FLAGS) if seen.flags >> i & 1),
        unwritten=named(seen.unwritten),
        read=named(seen.read),
        written=named(seen.written),
        where=(place_of(seen.place, routine) or where) if seen.what else "",
        sentence=text(seen.sentence),
        place=seen.place,
    )


def place_of(place: int, routine: Routine) -> str:
    """Line of the user's file that an instruction belongs to, or ""."""
    if not place:
        return ""
    from usersub.routine.places import locate

    found = locate(place)
    where = found.where if found else ""
    # A compilation out of the cache may be that of a copy of the file.
    file, _, line = where.rpartition(":")
    own = Path(routine.origin.rpartition(":")[0] or routine.origin)
    return f"{own}:{line}" if file and own.name == Path(file).name else where


def attach(raised: RoutineError, seen: Observed) -> None:
    """Gives an exception what was seen."""
    raised.argument, raised.access, raised.where = seen.argument, seen.access, seen.where
    raised.element, raised.index = seen.element, seen.index
