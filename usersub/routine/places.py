# SPDX-License-Identifier: MIT
"""From addresses to lines of the source, by debug information (DWARF), and to names of data."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Place:
    """Where an instruction is.

    Attributes:
        library: path of the shared object.
        function: symbol of the function, or "".
        where: "file:line", with the whole path of the file where it is there; "" if nobody knows.
    """

    library: str
    function: str = ""
    where: str = ""


def locate(address: int) -> Place | None:
    """The place of an instruction of this process; None if no file holds it (Linux)."""
    for first, last, offset, path in _mapped():
        if first <= address < last:
            return _in_file(path, address - first + offset)
    return None


def variable(library: str, address: int) -> str:
    """Symbol of the data of a loaded library that stand at an address; "" if nobody knows."""
    base = next(
        (first for first, _, offset, path in _mapped() if path == library and not offset), 0
    )
    return _symbol(library, address - base, ("STT_OBJECT", "STT_COMMON")) if base else ""


def _symbol(library: str, address: int, kinds: tuple[str, ...]) -> str:
    from elftools.common.exceptions import ELFError
    from elftools.elf.elffile import ELFFile

    try:
        with open(library, "rb") as file:
            return _covering(ELFFile(file), address, kinds)
    except (OSError, ELFError):
        return ""


def _mapped() -> Iterator[tuple[int, int, int, str]]:
    """Parts of files in memory: addresses, offset in the file, path."""
    try:
        lines = Path("/proc/self/maps").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return
    for line in lines:
        words = line.split(maxsplit=5)
        if len(words) == 6 and words[5].startswith("/"):
            first, last = (int(word, 16) for word in words[0].split("-"))
            yield first, last, int(words[2], 16), words[5]


@functools.lru_cache(maxsize=64)
def _in_file(path: str, offset: int) -> Place:
    from elftools.common.exceptions import DWARFError, ELFError
    from elftools.elf.elffile import ELFFile

    try:
        with open(path, "rb") as file:
            elf = ELFFile(file)
            address = next(
                (
                    offset - part["p_offset"] + part["p_vaddr"]
                    for part in elf.iter_segments("PT_LOAD")
                    if part["p_offset"] <= offset < part["p_offset"] + part["p_filesz"]
                ),
                None,
            )
            if address is None:
                return Place(path)
            where = _line(elf.get_dwarf_info(), address) if elf.has_dwarf_info() else ""
            return Place(path, _covering(elf, address, ("STT_FUNC",)), where)
    except (OSError, ELFError, DWARFError, ValueError, KeyError, IndexError):
        return Place(path)


def _covering(elf, address: int, kinds: tuple[str, ...]) -> str:
    """The symbol whose bytes an address is one of."""
    for name in (".symtab", ".dynsym"):
        section = elf.get_section_by_name(name)
        for symbol in section.iter_symbols() if section else ():
            first, size = symbol["st_value"], symbol["st_size"]
            if symbol["st_info"]["type"] in kinds and first <= address < first + size:
                return symbol.name
    return ""


def _line(dwarf, address: int) -> str:
    for unit in dwarf.iter_CUs():
        program = dwarf.line_program_for_CU(unit)
        row = _row(program, address) if program is not None else None
        if row is not None:
            return f"{_file(unit, program, row.file)}:{row.line}"
    return ""


def _row(program, address: int):
    """The row of the line table that an instruction belongs to. Line 0 is code that no line has:
    the line before it stands for it."""
    before = named = None
    for entry in program.get_entries():
        state = entry.state
        if state is None:
            continue
        if before is not None and before.address <= address < state.address:
            return before if before.line else named
        before = None if state.end_sequence else state
        if state.end_sequence:
            named = None
        elif state.line:
            named = state
    return None


def _file(unit, program, number: int) -> str:
    """Path of a file of the line table; its name alone if it is not there any more."""
    modern = program["version"] >= 5
    entry = program["file_entry"][number if modern else number - 1]
    folders = program["include_directory"]
    name = Path(entry.name.decode("utf-8", "replace"))
    at = unit.get_top_DIE().attributes.get("DW_AT_comp_dir")
    base = Path(at.value.decode("utf-8", "replace")) if at else Path()
    index = entry.dir_index if modern else entry.dir_index - 1
    folder = Path(folders[index].decode("utf-8", "replace")) if 0 <= index < len(folders) else base
    path = base / folder / name
    return str(path) if path.is_file() else name.name
