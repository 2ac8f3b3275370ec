# SPDX-License-Identifier: MIT
"""Published Fortran files made ready for gfortran: a copy in the build folder, same line numbers.

The copy differs from the file in what a user does not see: line ends, byte-order mark, comments
(the preprocessor stumbles over quotes and `/*` in them), the names of include files (found in any
case, ours or beside the source), what `fortran_repairs` mends, and
`#include <SMAAspUserSubroutines.hdr>`: wherever it stands, its declarations go where Fortran allows
them, into every unit that calls such a function and does not declare it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from usersub.errors import CompileError, LoadError
from usersub.routine import fortran_repairs, fortran_text
from usersub.routine.fortran_text import Unit

_HEADER = re.compile(r"^smaaspuser\w*\.hdr$", re.I)
_IMPLICIT = re.compile(r"^\s+implicit\b", re.I | re.M)
_DEEPEST = 20


@dataclass(frozen=True)
class Prepared:
    """What is compiled: `files` by their names in the build folder, the `main` one, its form."""

    files: dict[str, bytes]
    main: str
    free: bool


def prepare(source: Path, folders: tuple[Path, ...], free: bool | None = None) -> Prepared:
    """Reads `source` and what it includes.

    Args:
        folders: our own include folders, searched before the folder of the source.
        free: form of the source; None takes it from the suffix and the directives in it.

    Raises:
        LoadError: the file cannot be read. CompileError: include files include each other.
    """
    text = _read(source)
    if free is None:
        free = fortran_text.is_free(source.suffix, text)
    copier = _Copier(folders, free)
    main = "usub_main.F90" if free else "usub_main.F"
    copier.files[main] = b""
    copier.files[main], _ = copier.copy(text, source.name, source.parent, 0)
    return Prepared(copier.files, main, free)


def _read(path: Path) -> str:
    """Text of a file, bytes kept (Latin-1 maps each to itself), line ends made plain."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise LoadError(f"{path} cannot be read: {error.strerror}") from error
    data = data.removeprefix(b"\xef\xbb\xbf").rstrip(b"\x1a")
    data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    # A form feed before a line would count as a column.
    return re.sub(rb"^\f+", b"", data, flags=re.M).decode("latin-1")


def declarations(folders: tuple[Path, ...]) -> dict[str, list[str]]:
    """Interface blocks of the functions of our headers, by lower-case name."""
    found: dict[str, list[str]] = {}
    for folder in folders:
        for header in sorted(folder.glob("*.hdr")):
            _blocks(header.read_text(encoding="ascii"), found)
    return found


def _blocks(text: str, found: dict[str, list[str]]) -> None:
    generic, block, body = "", [], []
    for line in text.splitlines():
        code = " ".join(line.lower().split())
        if code.startswith("interface"):
            generic, block = code.removeprefix("interface").strip(), [line]
        elif code == "end interface":
            if generic:
                found[generic] = [*block, line]
            block = []
        elif block:
            block.append(line)
            if code.startswith("function "):
                body = [line]
            elif code.startswith("end function"):
                if not generic:
                    name = code.split()[-1]
                    found[name] = ["      interface", *body, line, "      end interface"]
                body = []
            elif body:
                body.append(line)


class _Copier:
    def __init__(self, folders: tuple[Path, ...], free: bool):
        self.folders = folders
        self.free = free
        self.files: dict[str, bytes] = {}
        self._names: dict[Path, str] = {}
        self._typing: set[str] = set()
        self._known = declarations(folders)

    def copy(self, text: str, name: str, folder: Path, depth: int) -> tuple[bytes, bool]:
        """The copy of one file, with a marker for its name in front, and whether it or a file that
        it includes sets implicit types."""
        if depth > _DEEPEST:
            raise CompileError(f"{name}: include files are nested deeper than {_DEEPEST}")
        lines: list[str] = []
        typing: list[int] = []
        for index, line in enumerate(fortran_text.lines_of(text)):
            included = fortran_text.include_of(line)
            if included is not None:
                line, types = self._include(line, included, folder, depth)
                if types:
                    typing.append(index)
            elif fortran_text.is_comment(line, self.free):
                line = ""
            else:
                line = fortran_repairs.quiet_comment(line)
            lines.append(line)
        # Markers have to come back the same from the preprocessor, which escapes other characters.
        shown = re.sub(r"[^\w.,;+()' -]", "_", name, flags=re.ASCII)
        found = fortran_text.units("\n".join(lines), self.free, name)
        added = self._added(found, typing)
        fortran_repairs.without_vendor_modules(lines, found)
        fortran_repairs.without_double_typing(lines, found, typing)
        order = fortran_repairs.modules_first(found, len(lines)) or range(len(lines))
        made, expected = [], -1
        for index in order:
            if index != expected:
                made.append(f'# {index + 1} "{shown}"')
            made += [lines[index], *added.get(index, ())]
            expected = index + 1 if index not in added else -1
        types = bool(typing or _IMPLICIT.search(text))
        return ("\n".join(made) + "\n").encode("latin-1"), types

    def _include(self, line: str, name: str, folder: Path, depth: int) -> tuple[str, bool]:
        """The line with the name of the copy, and whether the file sets implicit types."""
        if _HEADER.match(re.split(r"[/\\]", name)[-1]):
            return "", False
        path = self._resolve(name, folder)
        if path is None:
            return line, False
        if path not in self._names:
            made = f"usub_{len(self._names)}.inc"
            self._names[path] = made
            text = _read(path)
            self.files[made], types = self.copy(text, path.name, path.parent, depth + 1)
            if types:
                self._typing.add(made)
        made = self._names[path]
        if depth and made not in self.files:
            raise CompileError(f"{path.name}: the file includes itself")
        mark = "#include" if line.lstrip().startswith("#") else "      include"
        return f'{mark} "{made}"', made in self._typing

    def _resolve(self, name: str, folder: Path) -> Path | None:
        """Ours in any case, else beside the source, else there in any case."""
        plain = name.replace("\\", "/")
        for ours in self.folders:
            for path in _any_case(ours, plain):
                return path
        for path in _any_case(folder, plain):
            return path
        return None

    def _added(self, found: list[Unit], typing: list[int]) -> dict[int, list[str]]:
        """Declarations to insert, by the index of the line before them."""
        defined = {unit.name for unit in found}
        modules = [unit for unit in found if unit.kind == "module"]
        added: dict[int, list[str]] = {}
        for unit in found:
            wanted = [
                function
                for function in self._known
                if function not in defined
                and fortran_text.uses(unit, function)
                and not any(fortran_text.declares(u, function) for u in (unit, *modules))
            ]
            if wanted:
                place = fortran_text.place_for_declarations(unit)
                own = [i for i in typing if fortran_text.owner(found, i) is unit]
                lines = [line for function in wanted for line in self._known[function]]
                added.setdefault(max([place, *own]), []).extend(lines)
        return added


def _any_case(folder: Path, name: str) -> list[Path]:
    """The file `name` (it may have folders) under `folder`: exact, else the same without case."""
    exact = folder / name
    if exact.is_file():
        return [exact]
    here = [folder]
    for part in Path(name).parts:
        if part == "..":
            here = [h.parent for h in here]
        elif part not in (".", "/"):
            here = [
                child
                for h in here
                if h.is_dir()
                for child in sorted(h.iterdir())
                if child.name.lower() == part.lower()
            ]
    return [path for path in here if path.is_file()]
