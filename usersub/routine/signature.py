# SPDX-License-Identifier: MIT
"""The argument list of user code against the tables, before the first call.

Positions and counts decide, never names: published code renames freely. Files with invented
argument lists are in circulation; they link under the right name and write through wrong pointers.
"""

from __future__ import annotations

from usersub import abi
from usersub.errors import AbiError
from usersub.routine.debuginfo import Parameter, Signature

_TITLES = {"int": "integer", "real": "real", "char": "character", "logical": "logical",
           "complex": "complex", "other": "structure"}  # fmt: skip


def _said(kind: str, size: int, language: str) -> str:
    """A type in the words of its language."""
    if language == "fortran":
        title = _TITLES.get(kind, kind)
        return title if kind in ("other", "") or not size else f"{title}*{size}"
    names = {("real", 8): "double", ("real", 4): "float", ("int", 4): "int", ("int", 8): "long",
             ("int", 2): "short"}  # fmt: skip
    if kind == "char":
        return "char"
    return names.get((kind, size), f"{_TITLES.get(kind, 'unknown')} of {size} bytes")


def _expected(argument: abi.Arg, precision: str) -> tuple[str, int]:
    if argument.kind == "real":
        return "real", 8 if precision == "double" else 4
    return ("int", 4) if argument.kind == "int" else ("char", 0)


def check(
    found: Signature,
    face: abi.Interface,
    precision: str,
    language: str,
    unused: frozenset[int] = frozenset(),
) -> None:
    """Compares count and kinds of `found` with the interface.

    Args:
        unused: positions that the code does not use; an undeclared name in the place of a text is
            harmless there (published code leaves unused names undeclared).

    Raises:
        AbiError: file, line, what was found and what was expected.
    """
    where = f"{found.file}:{found.line}: {face.name.upper()}"
    count, right = len(found.parameters), len(face.args)
    hidden = sum(a.kind == "char" for a in face.args)
    counts = (right,) if language == "fortran" else (right, right + hidden)
    if count not in counts:
        wanted = f"{right}" if language == "fortran" else f"{right} (or {right + hidden} with the "
        if language != "fortran":
            wanted += "lengths of the names)"
        raise AbiError(
            f"{where} has {count} arguments, expected {wanted}; the list is "
            f"{', '.join(a.modern for a in face.args)}"
        )
    found_faults = faults(found, face, precision, language, unused)
    if found_faults:
        words = [
            f"argument {i + 1} ({_place(found, i)}'{found.parameters[i].name or 'unnamed'}', in "
            f"the place of {face.args[i].modern}) {fault}"
            for i, fault in found_faults[:3]
        ]
        left = len(found_faults) - 3
        more = f"; and {left} more arguments" if left > 0 else ""
        raise AbiError(f"{where}: {'; '.join(words)}{more}")


def _place(found: Signature, position: int) -> str:
    line = found.parameters[position].line
    return f"line {line}, " if line > found.line else ""


def faults(
    found: Signature,
    face: abi.Interface,
    precision: str,
    language: str,
    unused: frozenset[int] = frozenset(),
) -> list[tuple[int, str]]:
    """What is wrong with the kinds of arguments, by position; arguments as of `check`."""
    judged = (
        (i, _fault(parameter, argument, precision, language, i in unused))
        for i, (parameter, argument) in enumerate(zip(found.parameters, face.args, strict=False))
    )
    return [(i, fault) for i, fault in judged if fault]


def _fault(
    parameter: Parameter, argument: abi.Arg, precision: str, language: str, unused: bool
) -> str:
    """What is wrong with one argument, or ""."""
    kind, size = _expected(argument, precision)
    pointer = "" if language == "fortran" else " *"
    if parameter.passing == "value":
        return f"is passed by value, expected the address '{_said(kind, size, language)}{pointer}'"
    if parameter.passing == "descriptor":
        return "has assumed shape (:), which the interface cannot pass; give its dimensions"
    if parameter.kind == "":
        return ""
    if parameter.kind == "other" and language != "fortran" and kind == "real":
        # A structure of the components of a column, say; its members are not looked at.
        if parameter.size and parameter.size % size == 0:
            return ""
    if kind == "char" and language == "fortran" and unused and parameter.kind != "char":
        return ""
    if parameter.kind == kind and size in (0, parameter.size):
        return ""
    build = f" in {precision} precision" if kind == "real" and parameter.kind == "real" else ""
    return (
        f"is {_said(parameter.kind, parameter.size, language)}{pointer}, "
        f"expected {_said(kind, size, language)}{pointer}{build}"
    )


def generation(found: Signature | None, name: str, language: str) -> str | None:
    """Generation of FRIC_COEF that the code was written for; None if nothing tells.

    Ranks decide in Fortran, then the names of arguments 7 and 13, then rank 1 of fCoef.
    """
    if name != "fric_coef":
        return abi.LEGACY
    if found is None or len(found.parameters) < 13:
        return None
    coefficient, derivative = found.parameters[0], found.parameters[1]
    slip = found.parameters[12]
    if coefficient.rank >= 2 or derivative.rank >= 3 or slip.rank >= 2:
        return abi.RELEASE_2022
    names = {found.parameters[6].name.lower(), slip.name.lower()}
    if names & {"slipdata", "idata"}:
        return abi.RELEASE_2022
    if names & {"sliprate", "jflags"} or (language == "fortran" and coefficient.rank == 1):
        return abi.LEGACY
    return None
