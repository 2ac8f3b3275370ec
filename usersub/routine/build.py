# SPDX-License-Identifier: MIT
"""From objects to a library in the cache, and what is known of it."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from usersub import abi
from usersub.errors import CompileError, LoadError
from usersub.routine import cache, compilers, debuginfo, objects, solver

#: Version of what is stored of a build; part of every key.
RECORD = "9"
_UNDEFINED = re.compile(r"undefined (?:reference to [`']|symbol: )([^'`\s]+)")


@dataclass(frozen=True)
class Build:
    """A compiled source, or a prebuilt library, in one precision.

    Attributes:
        library: the shared object.
        source: the user's file.
        language: "fortran", "c", "c++" or "library".
        precision: "double" or "single".
        compiler: its own words; "" for a prebuilt library.
        flags: compiler flags, without folders.
        functions: external functions that the source defines.
        signatures: argument lists by symbol, where there is debug information.
        unused: positions of arguments that are not used, by symbol; no entry: not known.
        shared: variables that outlive a call.
        writes_units: it uses Fortran units.
        absent: functions that do not exist here; a call of one ends the call of the routine.
        guarded: symbols of block style that turn C++ exceptions into a status, by interface.
        missing: symbols that a prebuilt library needs from others.
    """

    library: Path
    source: Path
    language: str
    precision: str
    compiler: str
    flags: tuple[str, ...]
    functions: tuple[str, ...]
    signatures: dict[str, debuginfo.Signature]
    unused: dict[str, tuple[int, ...]]
    shared: tuple[str, ...]
    writes_units: bool
    absent: tuple[str, ...] = ()
    guarded: dict[str, str] | None = None
    missing: tuple[str, ...] = ()

    @property
    def interfaces(self) -> tuple[str, ...]:
        """Names of the interfaces that the source defines, in the order of the tables."""
        return tuple(name for name in abi.NAMES if name + "_" in self.functions)

    @property
    def source_language(self) -> str:
        """Language of the source; of a prebuilt library what its debug information says."""
        if self.language != "library":
            return self.language
        fortran = any(signature.fortran for signature in self.signatures.values())
        return "fortran" if fortran else "c"


def interface_symbols() -> set[str]:
    """External names of the five interfaces."""
    return {name + "_" for name in abi.NAMES}


def recall(library: Path, source: Path) -> Build | None:
    """The build of an earlier time, or None."""
    record = library.with_suffix(".json")
    try:
        stored: dict[str, Any] = json.loads(record.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if stored.pop("record", None) != RECORD or not library.is_file():
        return None
    signatures = {
        symbol: debuginfo.Signature(
            s["symbol"],
            s["file"],
            s["line"],
            s["fortran"],
            tuple(debuginfo.Parameter(**p) for p in s["parameters"]),
        )
        for symbol, s in stored.pop("signatures").items()
    }
    stored["unused"] = {s: tuple(positions) for s, positions in stored["unused"].items()}
    lists: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in stored.items()}
    return Build(library=library, source=source, signatures=signatures, **lists)


def remember(build: Build) -> None:
    """Writes what is known of a build beside its library."""
    stored = asdict(build)
    del stored["library"], stored["source"]
    stored["record"] = RECORD
    cache.put_text(json.dumps(stored), build.library.with_suffix(".json"))


def link(
    compiler: compilers.Compiler,
    source: Path,
    parts: list[Path],
    flags: tuple[str, ...],
    target: Path,
) -> tuple[str, ...]:
    """Links `parts` (the object of the source first) with `flags` into `target`.

    Functions that do not exist here are an error if one of the interfaces can come to call them;
    other entries of the file (a UEL, a VUMAT), and all calls of utility routines that only the
    commercial solver has, get a function that says so and ends the call.

    Returns:
        the names of such functions.

    Raises:
        LoadError: symbols that an interface needs are nowhere. CompileError: the linker's words.
    """
    made = parts[0].with_name("linked.so")
    command = [*compiler.command, "-o", str(made), *map(str, parts), *flags]
    outcome = compilers.run(command, parts[0].parent)
    absent: tuple[str, ...] = ()
    if outcome.code:
        absent = tuple(sorted(set(_UNDEFINED.findall(outcome.text))))
        if not absent:
            raise compilers.refusal(compiler, source, outcome)
        _refuse_if_reached(source, parts[0], absent)
        stub = _stand_ins(compiler, parts[0].parent, absent)
        command.insert(command.index("-o"), str(stub))
        outcome = compilers.run(command, parts[0].parent)
        if outcome.code:
            raise compilers.refusal(compiler, source, outcome)
    cache.put(made, target)
    return absent


def _refuse_if_reached(source: Path, part: Path, absent: tuple[str, ...]) -> None:
    interfaces = interface_symbols()
    reached = objects.reached(part, interfaces) if objects.is_elf(part) else set(absent)
    needed = sorted(name for name in reached.intersection(absent) if not solver.is_utility(name))
    other = sorted(set(absent) - reached)
    plain = [name for name in other if not name.endswith("_")]
    if needed or plain:
        names = ", ".join(_shown(name) for name in needed or plain)
        raise LoadError(f"{source.name} calls {names}, which neither the file nor usersub defines")


def _shown(symbol: str) -> str:
    return symbol.removesuffix("_").upper() if symbol.endswith("_") else symbol


def _stand_ins(compiler: compilers.Compiler, folder: Path, absent: tuple[str, ...]) -> Path:
    """An object with functions that say that they do not exist here, and end the call."""
    lines = ["extern void usub_missing_routine(const char *);"]
    lines += [
        f'void {symbol}(void) {{ usub_missing_routine("{_shown(symbol)}"); }}' for symbol in absent
    ]
    source = folder / "usub_absent.c"
    source.write_text("\n".join(lines) + "\n", encoding="ascii")
    made = source.with_suffix(".o")
    command = [*compiler.command, "-x", "c", "-c", "-fPIC", source.name, "-o", made.name]
    outcome = compilers.run(command, folder)
    if outcome.code:
        names = ", ".join(_shown(name) for name in absent)
        raise CompileError(f"no stand-in for {names} could be compiled: {outcome.text.strip()}")
    return made
