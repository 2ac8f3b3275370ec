# SPDX-License-Identifier: MIT
"""Loading a file of user code, in any language, as routines."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path

from usersub import abi
from usersub.errors import AbiError, LoadError
from usersub.routine import c, fortran, library, messages, needs, signature
from usersub.routine.build import Build
from usersub.routine.native import Code
from usersub.routine.routine import Routine

_LANGUAGES = {
    **dict.fromkeys(fortran.SUFFIXES, "fortran"),
    **dict.fromkeys(c.C_SUFFIXES, "c"),
    **dict.fromkeys(c.CXX_SUFFIXES, "c++"),
    **dict.fromkeys((*library.SUFFIXES, *library.OBJECT_SUFFIXES), "library"),
    ".py": "python",
}


#: Functions that a message lists, at most.
_LISTED = 12


class RoutineFile(Mapping[str, Routine]):
    """The routines of one file by interface name ("vfric", any case).

    Attributes:
        path: the file.
        language: "python", "c", "c++", "fortran" or "library".
        precision: the precision in which it was loaded first.
    """

    def __init__(
        self,
        path: Path,
        language: str,
        precision: str,
        routines: dict[str, Routine],
        code: Code | None = None,
    ):
        self.path, self.language, self.precision = path, language, precision
        self.code = code
        self._routines = routines

    def __getitem__(self, interface: str) -> Routine:
        found = self._routines.get(interface.lower())
        if found is None:
            raise LoadError(
                f"{self.path.name} has no {interface.upper()}; it has "
                f"{', '.join(name.upper() for name in self._routines)}"
            )
        return found

    def __contains__(self, interface: object) -> bool:
        return isinstance(interface, str) and interface.lower() in self._routines

    def __iter__(self) -> Iterator[str]:
        return iter(self._routines)

    def __len__(self) -> int:
        return len(self._routines)

    def __repr__(self) -> str:
        names = ", ".join(name.upper() for name in self._routines)
        return f"<RoutineFile {self.path.name}: {names}>"

    def only(self) -> Routine:
        """The routine of a file that has a single one.

        Raises:
            LoadError: it has several; the message lists them.
        """
        if len(self._routines) != 1:
            names = list(self._routines)
            raise LoadError(
                f"{self.path.name} has {len(names)} routines "
                f"({', '.join(name.upper() for name in names)}); choose one, "
                f"for example file['{names[0]}']"
            )
        return next(iter(self._routines.values()))

    def symbol(self, name: str, precision: str | None = None) -> int:
        """Address of any function of the file, such as "uel" or "vumat"; its COMMON data are those
        of the routines.

        Raises:
            LoadError: no such function; the message lists those that the file has.
        """
        if self.code is None:
            raise LoadError(f"{self.path.name} is a Python file and has no symbols")
        return self.code.symbol(name, precision or self.precision)


def load(
    path: str | os.PathLike[str],
    *,
    precision: str = "double",
    generation: str | None = None,
    interface: str | None = None,
) -> RoutineFile:
    """Loads every interface that a file defines: Python, C, C++, Fortran, library or object.

    Args:
        path: the file; its suffix says the language.
        precision: "double" or "single" (explicit interfaces); a prebuilt library's own. The other
            precision of a source is compiled when a driver asks for it.
        generation: of FRIC_COEF, "legacy" or "2022"; None reads it from the code.
        interface: load only this one; argument lists of others are not checked then.

    Raises:
        LoadError: no such file, unknown suffix, no interface in it, symbols that nobody defines.
        CompileError: file:line:column and the compiler's words.
        MissingTool: no compiler; how to install it.
        AbiError: an argument list that is not that of the interface.
    """
    file = Path(path).expanduser().absolute()
    if precision not in ("double", "single"):
        raise AbiError(f"precision is '{precision}', expected 'double' or 'single'")
    if generation not in (None, abi.LEGACY, abi.RELEASE_2022):
        raise AbiError(
            f"generation is {generation!r}, expected '{abi.LEGACY}' or '{abi.RELEASE_2022}'"
        )
    if file.is_dir():
        raise LoadError(f"{file} is a folder, expected a file")
    if not file.is_file():
        raise LoadError(f"there is no file {file}")
    language = _language(file)
    if language == "python":
        from usersub.routine.pyfile import load_python

        found = load_python(file, generation)
        return RoutineFile(file, language, precision, _chosen(file, found, interface))
    if language != "library":
        _check_text(file)
    code = Code(file, language, precision)
    build = code.build(precision)
    if not build.interfaces:
        raise LoadError(_nothing(build))
    names = _chosen(file, dict.fromkeys(build.interfaces), interface)
    made = {}
    for name in names:
        try:
            made[name] = _routine(code, name, generation)
        except AbiError as error:
            others = [other for other in names if other != name]
            if others:
                error.args = (f"{error} (interface='{others[0]}' loads {others[0].upper()} alone)",)
            raise
    return RoutineFile(file, language, precision, made, code)


def _language(file: Path) -> str:
    name, suffix = file.name.lower(), file.suffix.lower()
    if suffix not in _LANGUAGES and ".so." in name:
        return "library"
    if suffix not in _LANGUAGES:
        raise LoadError(
            f"{file.name} has the suffix '{file.suffix}', expected one of {', '.join(_LANGUAGES)}"
        )
    return _LANGUAGES[suffix]


def _check_text(file: Path) -> None:
    """Refuses what no compiler reads, in one sentence instead of a hundred of the compiler's."""
    try:
        with file.open("rb") as opened:
            head = opened.read(1 << 16)
    except OSError as error:
        raise LoadError(f"{file} cannot be read: {error.strerror}") from error
    if head.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise LoadError(f"{file.name} is in UTF-16, which compilers do not read; save it as UTF-8")
    if b"\0" in head:
        line = head[: head.index(b"\0")].count(b"\n") + 1
        raise LoadError(f"{file.name} is not a text file: line {line} has a zero byte")


def _chosen(file: Path, found: dict, interface: str | None) -> dict:
    if interface is None:
        return found
    name = interface.lower()
    abi_names = ", ".join(n.upper() for n in abi.NAMES)
    if name not in abi.NAMES:
        raise LoadError(f"'{interface}' is not an interface; the interfaces are {abi_names}")
    if name not in found:
        there = ", ".join(n.upper() for n in found)
        raise LoadError(f"{file.name} has no {interface.upper()}; it has {there}")
    return {name: found[name]}


def _nothing(build: Build) -> str:
    """Why a file without an interface cannot be loaded."""
    names = ", ".join(name.upper() for name in abi.NAMES)
    near = [f for f in build.functions if _nearly(f)]
    if near and build.language != "fortran":
        return (
            f"{build.source.name} defines '{near[0]}', which no host finds; name the function "
            f"FOR_NAME({_nearly(near[0])},{_nearly(near[0]).upper()}) of omi_for_c.h, "
            'in C++ behind extern "C"'
        )
    shown = [f.removesuffix("_").upper() for f in build.functions[:_LISTED]]
    if len(build.functions) > _LISTED:
        shown.append(f"and {len(build.functions) - _LISTED} more")
    others = ", ".join(shown) or "nothing"
    return (
        f"{build.source.name} has none of the interfaces {names}; the functions that it defines: "
        f"{others}"
    )


def _nearly(symbol: str) -> str:
    """The interface that a C function without FOR_NAME or a mangled C++ name was meant for."""
    for name in sorted(abi.NAMES, key=len, reverse=True):
        plain = symbol.lower().strip("_")
        if plain == name or symbol.startswith(
            (f"_Z{len(name)}{name}", f"_Z{len(name) + 1}{name}_")
        ):
            return name
    return ""


def _routine(code: Code, name: str, generation: str | None) -> Routine:
    symbol = name + "_"
    # FRIC and FRIC_COEF exist in double precision only, whatever the file was asked for in.
    compiled = code.language != "library"
    double = compiled and code.precision not in abi.interface(name).precisions
    build = code.build("double" if double else code.precision)
    found = build.signatures.get(symbol)
    face = abi.interface(name, _generation(build, name, generation))
    code.check(face, build.precision)
    line = f":{found.line}" if found else ""
    return Routine(
        interface=face,
        language=build.language,
        name=build.source.name,
        origin=f"{build.source}{line}",
        make_entry=partial(code.entry, face),
        uses=needs.uses(face, build.unused.get(symbol)),
        block_safe=name != "fric_coef",
        # Units are shared, and lines have to come in the order of the points.
        thread_safe=not build.shared and not build.writes_units,
        after_call=messages.after_call if build.writes_units else None,
    )


def _generation(build: Build, name: str, asked: str | None) -> str:
    """Generation of one interface of a file; what is not known is taken for the newest, whose
    arrays have room for both."""
    known = [i.generation for i in abi.INTERFACES if i.name == name]
    if len(known) == 1:
        return known[0]
    if asked is not None and asked not in known:
        raise AbiError(f"generation of {name.upper()} is '{asked}', expected {' or '.join(known)}")
    found = signature.generation(build.signatures.get(name + "_"), name, build.source_language)
    if asked == abi.LEGACY and found == abi.RELEASE_2022:
        raise AbiError(
            f"{build.source.name}: {name.upper()} is written for generation 2022 "
            "(fCoef(nBlock,2), slipData), but generation 'legacy' is asked for"
        )
    return asked or found or known[-1]
