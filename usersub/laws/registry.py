# SPDX-License-Identifier: MIT
"""The shipped laws by name, read from the `law.toml` of their folders when they are asked for."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from functools import cache, cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from usersub import abi, paths
from usersub.errors import LoadError
from usersub.laws import lawfile
from usersub.laws.description import Law

if TYPE_CHECKING:
    from usersub.routine.loading import RoutineFile
    from usersub.routine.routine import Routine

#: File of a law by language.
LANGUAGES = {"python": "law.py", "c": "law.c", "fortran": "law.f90"}

#: File in which a law describes itself; a folder that holds one is a law.
DESCRIPTION = "law.toml"


class Laws(Mapping[str, Law]):
    """The laws of a folder by name; each is read once, at its first use."""

    def __init__(self, folder: Path | None = None):
        self._folder, self._read = folder, dict[str, Law]()

    @cached_property
    def _files(self) -> dict[str, Path]:
        folder = self._folder or paths.reference_impls()
        files = {path.parent.name: path for path in folder.glob(f"*/{DESCRIPTION}")}
        return dict(sorted(files.items()))

    def __getitem__(self, name: str) -> Law:
        if name not in self._read:
            self._read[name] = lawfile.read(self._files[name])
        return self._read[name]

    def __contains__(self, name: object) -> bool:
        return name in self._files

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def __repr__(self) -> str:
        return f"<{len(self)} laws: {', '.join(self)}>"


#: The shipped laws.
LAWS = Laws()


def law(name: str) -> Law:
    """The law called `name`.

    Raises:
        LoadError: there is none; the message names the nearest. Or its description is wrong.
    """
    if name not in LAWS:
        near = difflib.get_close_matches(name, LAWS, n=1, cutoff=0.4)
        hint = f"; did you mean '{near[0]}'?" if near else "."
        raise LoadError(f"no law is called '{name}'{hint} Laws: {', '.join(LAWS)}")
    return LAWS[name]


def path(name: str, language: str) -> Path:
    """File of a law in "python", "c" or "fortran".

    Raises:
        LoadError: unknown law or language, or the file is missing.
    """
    if language not in LANGUAGES:
        raise LoadError(f"laws are shipped in {', '.join(LANGUAGES)}, not in '{language}'")
    file = law(name).folder / LANGUAGES[language]
    if not file.is_file():
        raise LoadError(f"{file} is missing: the law {name} is not installed in {language}")
    return file


@cache
def load(name: str, language: str = "python", *, precision: str = "double") -> RoutineFile:
    """The routines of a law in one language, by interface; compiled once in a process.

    Raises:
        LoadError: unknown law or language.
        MissingTool: the compiler is missing.
    """
    from usersub.routine.loading import load as load_file

    return load_file(path(name, language), precision=precision)


def routine(
    name: str, interface: str, language: str = "python", *, precision: str = "double"
) -> Routine:
    """The routine of a law behind one interface.

    Raises:
        LoadError: unknown law or language, or the interface cannot carry the law or does not exist
            in this precision.
    """
    law(name).check(interface.lower())
    precisions = abi.interface(interface).precisions
    if precision not in precisions:
        raise LoadError(
            f"law '{name}' behind {interface.upper()} has no precision '{precision}'; "
            f"expected {' or '.join(precisions)}"
        )
    return load(name, language, precision=precision)[interface.lower()]
