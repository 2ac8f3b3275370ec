# SPDX-License-Identifier: MIT
"""A compiled or prebuilt file in the process: its builds by precision and their entries."""

from __future__ import annotations

import ctypes
from pathlib import Path

from usersub import abi
from usersub.errors import AbiError, LoadError
from usersub.routine import c, fortran, library, messages, signature
from usersub.routine.build import Build
from usersub.routine.routine import BLOCK, FULL, Entry


class Code:
    """A compiled or prebuilt file: its builds by precision, each loaded at the first request."""

    def __init__(self, path: Path, language: str, precision: str):
        self.path, self.language, self.precision = path, language, precision
        self._builds: dict[str, Build] = {}
        self._loaded: dict[str, ctypes.CDLL] = {}

    def build(self, precision: str) -> Build:
        """The build in `precision`, compiled if need be.

        Raises:
            AbiError: a prebuilt library that was loaded in the other precision.
        """
        if precision not in self._builds:
            if self.language == "library":
                if precision != self.precision:
                    raise AbiError(
                        f"{self.path.name} was loaded as built in {self.precision} precision, "
                        f"but {precision} is asked for; load the library of that build"
                    )
                made = library.examine(self.path, precision)
            elif self.language == "fortran":
                made = fortran.compile_file(self.path, precision)
            else:
                made = c.compile_file(self.path, self.language, precision)
            self._builds[precision] = made
        return self._builds[precision]

    def loaded(self, precision: str) -> ctypes.CDLL:
        """The library of the build, in the process."""
        if precision not in self._loaded:
            build = self.build(precision)
            if build.library == build.source:
                loaded = library.open_prebuilt(build.library, build.missing)
            else:
                loaded = library.open_library(build.library)
            if build.writes_units:
                messages.connect_units(loaded)
            self._loaded[precision] = loaded
        return self._loaded[precision]

    def check(self, face: abi.Interface, precision: str) -> None:
        """Compares the argument list with the table, where there is debug information.

        Raises:
            AbiError: they differ.
        """
        build = self.build(precision)
        found = build.signatures.get(face.symbol)
        if found is not None:
            unused = frozenset(build.unused.get(face.symbol, ()))
            signature.check(found, face, precision, build.source_language, unused)

    def entry(self, face: abi.Interface, precision: str) -> Entry:
        """Loads the code of one interface.

        Raises:
            AbiError: the interface does not exist in that precision, or the arguments differ.
        """
        if precision not in face.precisions:
            raise AbiError(
                f"{face.name.upper()} exists in {' and '.join(face.precisions)} precision, "
                f"not in '{precision}'"
            )
        self.check(face, precision)
        build = self.build(precision)
        guarded = (build.guarded or {}).get(face.name)
        loaded = self.loaded(precision)
        place = library.address(loaded, guarded or face.symbol)
        if not place:
            raise LoadError(f"{self.path.name} has no {face.name.upper()} in {precision} precision")
        return Entry(place, BLOCK if guarded else FULL, loaded)

    def symbol(self, name: str, precision: str) -> int:
        """Address of a function by its name, with or without the underscore, in any case."""
        loaded, build = self.loaded(precision), self.build(precision)
        known = {f.lower(): f for f in build.functions}
        plain = name.lower().removesuffix("_")
        for candidate in (plain + "_", plain):
            if candidate in known:
                return library.address(loaded, known[candidate])
        names = ", ".join(f.removesuffix("_") for f in build.functions)
        raise LoadError(f"{self.path.name} has no function '{name}'; it has {names}")
