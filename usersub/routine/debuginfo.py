# SPDX-License-Identifier: MIT
"""Argument lists of compiled functions, read from debug information (DWARF)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Parameter:
    """One argument as the compiler understood it.

    Attributes:
        name: as declared (gfortran: lower case); "" for an unnamed one.
        kind: "real", "int", "char", "logical", "complex" or "" (not known, for example `void *`).
        size: bytes of one element; of the whole text for "char" in Fortran; 0 if not known.
        rank: number of dimensions; -1 if not known (a C pointer).
        passing: "address", "value" or "descriptor" (Fortran assumed shape).
        line: where the name stands, 0 if not known.
        column: likewise.
    """

    name: str
    kind: str
    size: int
    rank: int
    passing: str
    line: int
    column: int


@dataclass(frozen=True)
class Signature:
    """Argument list of one function: external `symbol`, where it stands, whether in Fortran,
    `parameters` without the hidden character lengths that gfortran adds."""

    symbol: str
    file: str
    line: int
    fortran: bool
    parameters: tuple[Parameter, ...]


_KINDS = {1: "address", 2: "logical", 3: "complex", 4: "real", 5: "int", 6: "char", 7: "int",
          8: "char", 16: "char"}  # fmt: skip


def signatures(path: Path, symbols: set[str]) -> dict[str, Signature]:
    """Argument lists of those of `symbols` for which the ELF file has debug information."""
    found: dict[str, Signature] = {}
    for dwarf, unit in _units(path):
        fortran = _value(unit.get_top_DIE(), "DW_AT_language") in (7, 8, 14, 34, 35)
        for function in _functions(unit.get_top_DIE()):
            symbol = _symbol(function)
            if symbol in symbols:
                found[symbol] = _signature(dwarf, unit, function, symbol, fortran)
    return found


def variables(path: Path) -> dict[str, str]:
    """Where variables and COMMON blocks are declared ("file:line"), by lower-case name, in an ELF
    file with debug information. Of several of one name the first counts."""
    found: dict[str, str] = {}
    for dwarf, unit in _units(path):
        for die in unit.iter_DIEs():
            if die.tag not in ("DW_TAG_variable", "DW_TAG_common_block"):
                continue
            name, line = _text(die, "DW_AT_name"), _value(die, "DW_AT_decl_line")
            if name and line:
                found.setdefault(name.lower(), f"{_file(dwarf, unit, die)}:{line}")
    return found


def _units(path: Path) -> Iterator[tuple[Any, Any]]:
    """Debug information of an ELF file, once with each of its units; nothing without any."""
    from elftools.elf.elffile import ELFFile

    with path.open("rb") as file:
        elf = ELFFile(file)
        if elf.has_dwarf_info():
            dwarf = elf.get_dwarf_info()
            for unit in dwarf.iter_CUs():
                yield dwarf, unit


def _functions(top) -> Iterator:
    for die in top.iter_children():
        if die.tag in ("DW_TAG_module", "DW_TAG_namespace"):
            yield from _functions(die)
        elif die.tag == "DW_TAG_subprogram" and "DW_AT_declaration" not in die.attributes:
            yield die


def _value(die, attribute: str):
    """Value of an attribute of the entry or of the one that it completes."""
    for _ in range(8):
        if attribute in die.attributes:
            return die.attributes[attribute].value
        for link in ("DW_AT_abstract_origin", "DW_AT_specification"):
            if link in die.attributes:
                die = die.get_DIE_from_attribute(link)
                break
        else:
            return None
    return None


def _text(die, attribute: str) -> str:
    value = _value(die, attribute)
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else ""


def _symbol(function) -> str:
    return _text(function, "DW_AT_linkage_name") or _text(function, "DW_AT_name")


def _signature(dwarf, unit, function, symbol: str, fortran: bool) -> Signature:
    parameters = tuple(
        _parameter(die, fortran)
        for die in function.iter_children()
        if die.tag == "DW_TAG_formal_parameter" and not _is_hidden(die, fortran)
    )
    return Signature(
        symbol,
        _file(dwarf, unit, function),
        _value(function, "DW_AT_decl_line") or 0,
        fortran,
        parameters,
    )


def _is_hidden(die, fortran: bool) -> bool:
    """Whether the compiler added the parameter, as it does with the lengths of texts. It marks
    arrays of assumed shape like them."""
    if not _value(die, "DW_AT_artificial"):
        return False
    return not fortran or _parameter(die, fortran).passing != "descriptor"


def _file(dwarf, unit, function) -> str:
    number = _value(function, "DW_AT_decl_file")
    program = dwarf.line_program_for_CU(unit)
    if number is None or program is None:
        return ""
    entries = program["file_entry"]
    index = number if program["version"] >= 5 else number - 1
    return Path(entries[index].name.decode()).name if 0 <= index < len(entries) else ""


def _target(die):
    return die.get_DIE_from_attribute("DW_AT_type") if "DW_AT_type" in die.attributes else None


def _plain(die):
    """The type without names and qualifiers; None for void."""
    while die is not None and die.tag in (
        "DW_TAG_typedef",
        "DW_TAG_const_type",
        "DW_TAG_volatile_type",
        "DW_TAG_restrict_type",
        "DW_TAG_atomic_type",
    ):
        die = _target(die)
    return die


def _parameter(die, fortran: bool) -> Parameter:
    origin = die
    while "DW_AT_type" not in origin.attributes and "DW_AT_abstract_origin" in origin.attributes:
        origin = origin.get_DIE_from_attribute("DW_AT_abstract_origin")
    kind, size, rank, passing = _type(_plain(_target(origin)), fortran)
    return Parameter(
        _text(die, "DW_AT_name"),
        kind,
        size,
        rank,
        passing,
        _value(die, "DW_AT_decl_line") or 0,
        _value(die, "DW_AT_decl_column") or 0,
    )


def _type(die, fortran: bool) -> tuple[str, int, int, str]:
    """Kind, size, rank, passing of a parameter of this type."""
    passing, rank = ("address", 0) if fortran else ("value", 0)
    if die is not None and die.tag in ("DW_TAG_pointer_type", "DW_TAG_reference_type"):
        die, passing, rank = _plain(_target(die)), "address", 0 if fortran else -1
    if die is not None and die.tag == "DW_TAG_array_type":
        if "DW_AT_data_location" in die.attributes:
            passing = "descriptor"
        dimensions = sum(c.tag == "DW_TAG_subrange_type" for c in die.iter_children())
        rank = dimensions if fortran else -1
        die = _plain(_target(die))
    if die is None:
        return "", 0, rank, passing
    size = _value(die, "DW_AT_byte_size") or 0
    if die.tag == "DW_TAG_string_type":
        return "char", size, rank, passing
    if die.tag == "DW_TAG_base_type":
        return _KINDS.get(_value(die, "DW_AT_encoding"), ""), size, rank, passing
    return "other", size, rank, passing
