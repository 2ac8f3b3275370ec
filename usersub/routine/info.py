# SPDX-License-Identifier: MIT
"""What is known of a routine or a file: the data behind `usersub info`."""

from __future__ import annotations

import os
from dataclasses import asdict, dataclass

from usersub import abi
from usersub.routine import solver
from usersub.routine.build import Build
from usersub.routine.loading import RoutineFile, load
from usersub.routine.routine import READS, READS_AND_WRITES, UNUSED, WRITES, Routine

_DOES = {UNUSED: "unused", READS: "reads", WRITES: "writes", READS_AND_WRITES: "reads and writes"}


@dataclass(frozen=True)
class ArgumentInfo:
    """One argument: `name` (newer spelling), `declared` (in the code; "" if not known), `kind`,
    `shape`, and what the routine does with it: "unused", "reads", "writes", "reads and writes" or
    "not known"."""

    name: str
    declared: str
    kind: str
    shape: tuple[str, ...]
    does: str


@dataclass(frozen=True)
class RoutineInfo:
    """One routine.

    Attributes:
        interface, generation: what it is behind.
        name, origin, language: as of the Routine.
        checked: the argument list was compared with the table.
        arguments: in their order.
        thread_safe, block_safe: as of the Routine.
        notes: sentences on what is not known.
    """

    interface: str
    generation: str
    name: str
    origin: str
    language: str
    checked: bool
    arguments: tuple[ArgumentInfo, ...]
    thread_safe: bool
    block_safe: bool
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Info:
    """A file or a routine.

    Attributes:
        path: the file, or "".
        language: "python", "c", "c++", "fortran", "library" or "pointer".
        precision: the precision that was looked at; "" where it does not matter.
        compiler, flags: of compiled code, else empty.
        library: the shared object, or "".
        routines: one per interface.
        entries: other user subroutines of the file (UEL, VUMAT ...), upper case.
        functions: further functions of the file, upper case.
        shared_state: variables that outlive a call (COMMON, SAVE, static).
        absent: functions that do not exist here; a call of one ends the call of the routine.
        writes_units: it writes to Fortran units.
    """

    path: str
    language: str
    precision: str
    compiler: str
    flags: tuple[str, ...]
    library: str
    routines: tuple[RoutineInfo, ...]
    entries: tuple[str, ...]
    functions: tuple[str, ...]
    shared_state: tuple[str, ...]
    absent: tuple[str, ...]
    writes_units: bool

    def as_dict(self) -> dict:
        """The same as plain data, for JSON."""
        return asdict(self)


def info(thing: Routine | RoutineFile | str | os.PathLike[str], precision: str = "double") -> Info:
    """What is known of a routine, a loaded file, or the file at a path (loaded here).

    Raises:
        whatever `load` raises for a path.
    """
    if isinstance(thing, Routine):
        return Info(
            "", thing.language, "", "", (), "", (_routine(thing, None),), (), (), (), (), False
        )
    file = thing if isinstance(thing, RoutineFile) else load(thing, precision=precision)
    if file.code is None:
        routines = tuple(_routine(r, None) for r in file.values())
        return Info(str(file.path), file.language, "", "", (), "", routines, (), (), (), (), False)
    build = file.code.build(file.precision)
    plain = {f: f.removesuffix("_") for f in build.functions}
    others = sorted(n for n in plain.values() if n not in abi.NAMES and "_MOD___" not in n)
    return Info(
        path=str(file.path),
        language=file.language,
        precision=file.precision,
        compiler=build.compiler,
        flags=build.flags,
        library=str(build.library),
        routines=tuple(_routine(r, build) for r in file.values()),
        entries=tuple(n.upper() for n in others if n.lower() in solver.ENTRIES),
        functions=tuple(_readable(n) for n in others if n.lower() not in solver.ENTRIES),
        shared_state=build.shared,
        absent=tuple(n.removesuffix("_").upper() for n in build.absent),
        writes_units=build.writes_units,
    )


def _readable(name: str) -> str:
    """`__law_MOD_mu` -> LAW::MU."""
    module, mark, function = name.removeprefix("__").partition("_MOD_")
    return f"{module}::{function}".upper() if mark else name.upper()


def _routine(routine: Routine, build: Build | None) -> RoutineInfo:
    face = routine.interface
    found = build.signatures.get(face.symbol) if build else None
    arguments = tuple(
        ArgumentInfo(
            a.modern,
            found.parameters[i].name if found else "",
            a.kind,
            a.shape,
            _DOES[routine.uses[i]] if routine.uses is not None else "not known",
        )
        for i, a in enumerate(face.args)
    )
    return RoutineInfo(
        face.name,
        face.generation,
        routine.name,
        routine.origin,
        routine.language,
        found is not None or routine.language == "python",
        arguments,
        routine.thread_safe,
        routine.block_safe,
        tuple(_notes(routine, build, found is not None)),
    )


def _notes(routine: Routine, build: Build | None, checked: bool):
    if build is not None and not checked:
        yield "the argument list was not checked: the library has no debug information"
    if routine.uses is None:
        yield "which arguments are used is not known; all are taken as used"
    if build is not None and build.shared:
        yield f"not run in threads: it keeps {', '.join(build.shared)}"
    if build is not None and build.writes_units:
        yield "not run in threads: it uses Fortran units"
    if build is not None and routine.interface.name == "fric_coef" and not checked:
        yield "the generation is not known; one point a call fits both"
