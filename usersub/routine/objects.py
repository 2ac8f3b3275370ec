# SPDX-License-Identifier: MIT
"""What an ELF object or shared library says about itself: symbols, shared data, who needs what."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usersub.errors import LoadError

#: Routines of the Fortran run-time library that write to or open units.
_UNIT_CALLS = ("_gfortran_st_write", "_gfortran_st_read", "_gfortran_st_open")

# Data that every library has, or that C++ headers add: no state of the routine.
_HARMLESS = re.compile(
    r"^(DW\.ref\..*|_ZStL8__ioinit|_ZT[VISC].*|_ZGV.*|completed\.\d+|__dso_handle|__TMC_END__"
    r"|_DYNAMIC|_GLOBAL_OFFSET_TABLE_|__bss_start|_edata|_end|__frame_dummy_init_array_entry"
    r"|__do_global_dtors_aux_fini_array_entry|options\.\d+"
    r"|(?:__\w+_MOD_)?__(?:def_init|vtab)_.*)$"
)
# Sections that the loader writes once and the code never.
_FIXED = (".data.rel.ro", ".init_array", ".fini_array", ".dynamic", ".got", ".ctors", ".dtors",
          ".jcr", ".tm_clone_table")  # fmt: skip


@dataclass(frozen=True)
class Object:
    """Symbols of an object file or a library.

    Attributes:
        functions: external functions that it defines.
        missing: symbols that it needs and does not define.
        shared: variables that outlive a call (COMMON, SAVE, module, static), for people.
        writes_units: it reads or writes Fortran units.
    """

    functions: tuple[str, ...]
    missing: tuple[str, ...]
    shared: tuple[str, ...]
    writes_units: bool


def is_elf(path: Path) -> bool:
    """Whether the file is ELF (Linux, BSD); other systems' objects are loaded unread."""
    with path.open("rb") as file:
        return file.read(4) == b"\x7fELF"


def read(path: Path) -> Object:
    """Reads the symbol tables of an ELF file.

    Raises:
        LoadError: it is not ELF, or damaged.
    """
    from elftools.common.exceptions import ELFError
    from elftools.elf.elffile import ELFFile

    try:
        with path.open("rb") as file:
            return _read(ELFFile(file))
    except (ELFError, UnicodeDecodeError, KeyError, IndexError) as error:
        raise LoadError(f"{path} is not an object or library that can be read: {error}") from error


def _read(elf) -> Object:
    full, dynamic = elf.get_section_by_name(".symtab"), elf.get_section_by_name(".dynsym")
    functions, missing, shared = set(), set(), set()
    # Linked libraries say what others see in .dynsym; objects only have .symtab.
    for symbol in (dynamic or full).iter_symbols() if (dynamic or full) else ():
        info, index = symbol["st_info"], symbol["st_shndx"]
        if not symbol.name or info["bind"] == "STB_LOCAL":
            continue
        if index == "SHN_UNDEF":
            if info["bind"] != "STB_WEAK":
                missing.add(symbol.name)
        elif info["type"] in ("STT_FUNC", "STT_GNU_IFUNC"):
            functions.add(symbol.name)
    if full is not None:
        shared = {n for s in full.iter_symbols() if (n := _shared_name(elf, s))}
    elif dynamic is not None:
        shared = {n for s in dynamic.iter_symbols() if (n := _shared_name(elf, s))}
        shared |= _stripped_data(elf)
    return Object(
        tuple(sorted(functions)),
        tuple(sorted(missing)),
        tuple(sorted(shared)),
        any(name in missing for name in _UNIT_CALLS),
    )


def _shared_name(elf, symbol) -> str:
    """Name for people of a variable that outlives a call, or ""."""
    index, kind, size = symbol["st_shndx"], symbol["st_info"]["type"], symbol["st_size"]
    if not symbol.name or size == 0 or _HARMLESS.match(symbol.name):
        return ""
    if index in ("SHN_UNDEF", "SHN_ABS") or kind not in ("STT_OBJECT", "STT_COMMON", "STT_NOTYPE"):
        return ""
    if index == "SHN_COMMON":
        return _people(symbol.name, common=True)
    section = elf.get_section(index)
    writable = section["sh_flags"] & 0x1
    if not writable or section.name.startswith(_FIXED) or kind == "STT_NOTYPE":
        return ""
    return _people(symbol.name, common=False)


def _people(name: str, common: bool) -> str:
    """`blk_` -> COMMON /BLK/, `__m_MOD_x` -> module variable M::X, `count.0` -> count."""
    module = re.match(r"^__(\w+?)_MOD_(\w+)$", name)
    if module:
        return f"module variable {module[1].upper()}::{module[2].upper()}"
    if name == "__BLNK__":
        return "blank COMMON"
    if common or name.endswith("_"):
        return f"COMMON /{name.rstrip('_').upper()}/"
    return f"variable {_last_name(name) if name.startswith('_Z') else name.split('.')[0]}"


def _last_name(mangled: str) -> str:
    """Innermost name of a mangled C++ name (`_ZN3law5countE` -> count)."""
    name, at = mangled, 2
    while found := re.compile(r"\d+").search(mangled, at):
        at = found.end() + int(found[0])
        name = mangled[found.end() : at] or name
    return name


def _stripped_data(elf) -> set[str]:
    """A stripped library keeps no names; more data than the compiler's own start-up code has is
    taken for state of the routine."""
    return {words for words, _ in _stripped_sections(elf)}


def _stripped_sections(elf) -> list[tuple[str, int]]:
    """Sections with such data, in words, and their bytes."""
    found = [(s.name, s["sh_size"]) for s in elf.iter_sections() if s.name in (".data", ".bss")]
    return [
        (f"{size} bytes of {name} (the library has no names)", size)
        for name, size in found
        if size > 8
    ]


@dataclass(frozen=True)
class Kept:
    """A variable of an object file that outlives a call: its name for people and its bytes."""

    people: str
    size: int


def kept_by(path: Path, start: Iterable[str] | None = None) -> list[Kept]:
    """Writable variables that the functions `start` of an object can come to touch; all of them
    without `start`.

    Needs one section a function and a variable (`-ffunction-sections -fdata-sections`).
    """
    from elftools.elf.elffile import ELFFile

    with path.open("rb") as file:
        elf: Any = ELFFile(file)
        table = elf.get_section_by_name(".symtab")
        if table is None:
            return [Kept(words, size) for words, size in _stripped_sections(elf)]
        symbols = list(table.iter_symbols())
        of_section: dict[int, list[Any]] = {}
        for symbol in symbols:
            if symbol["st_info"]["type"] == "STT_OBJECT" and isinstance(symbol["st_shndx"], int):
                of_section.setdefault(symbol["st_shndx"], []).append(symbol)
        if start is None:
            touched = {s.name: s for s in symbols if s.name}
        else:
            touched = {}
            for number, place in _walked(elf, symbols, start):
                # What is in the section alone, or what is named.
                named = symbols[number]
                inside = of_section.get(place, []) if not named.name else [named]
                touched.update((s.name, s) for s in inside if s.name)
        found = [
            Kept(people, int(symbol["st_size"]))
            for symbol in touched.values()
            if (people := _shared_name(elf, symbol))
        ]
        return sorted(found, key=lambda kept: kept.people)


def _walked(elf: Any, symbols: list, start: Iterable[str]) -> Iterator[tuple[int, int]]:
    """(number of a symbol, its section, -1 for none) of everything that is referred to from the
    functions `start` and what they call."""
    edges: dict[int, set[int]] = {}
    for section in elf.iter_sections():
        if section["sh_type"] in ("SHT_RELA", "SHT_REL"):
            target = elf.get_section(section["sh_info"])
            if target["sh_flags"] & 0x2 and not target.name.startswith(".eh_frame"):
                used = {r["r_info_sym"] for r in section.iter_relocations()}
                edges.setdefault(section["sh_info"], set()).update(used)
    home = {s.name: s["st_shndx"] for s in symbols if isinstance(s["st_shndx"], int) and s.name}
    todo = [home[name] for name in start if name in home]
    seen = set(todo)
    while todo:
        for number in edges.get(todo.pop(), ()):
            place = symbols[number]["st_shndx"]
            inside = isinstance(place, int)
            yield number, place if inside else -1
            if inside and place not in seen:
                seen.add(place)
                todo.append(place)


def reached(path: Path, start: Iterable[str]) -> set[str]:
    """Missing symbols that the functions `start` of an object can come to call.

    Needs one section a function (`-ffunction-sections`); what shares a section counts together.
    """
    from elftools.elf.elffile import ELFFile

    with path.open("rb") as file:
        elf: Any = ELFFile(file)
        symbols = list(elf.get_section_by_name(".symtab").iter_symbols())
        return {
            symbols[number].name
            for number, _ in _walked(elf, symbols, start)
            if symbols[number]["st_shndx"] == "SHN_UNDEF"
        }
