# SPDX-License-Identifier: MIT
"""What user code is compiled and linked against: include folders, library, wrapped symbols."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

from usersub import paths


@dataclass(frozen=True)
class Support:
    """Folders and flags of the installed package: `include` folder, `library`, and the functions
    that end a program (`wrapped`), which come back to the driver instead."""

    include: Path
    library: Path
    wrapped: tuple[str, ...]

    def include_folders(self, precision: str) -> tuple[Path, ...]:
        """Folders with our own include files, the one of the precision first."""
        field = self.include / "usersub" / "field"
        return field / precision, field, self.include

    @property
    def link_flags(self) -> tuple[str, ...]:
        """Flags that bind user code to itself first, then to the library.

        Names of COMMON blocks and of an own XIT collide between libraries otherwise.
        """
        library = (str(self.library), f"-Wl,-rpath,{self.library.parent}")
        if sys.platform == "darwin":
            return ("-dynamiclib", *library)
        wraps = tuple(f"-Wl,--wrap={name}" for name in self.wrapped)
        # gfortran's library is needed even if all that is called of it is wrapped.
        shared = ("-shared", "-Wl,-Bsymbolic", "-Wl,-z,defs", "-Wl,--no-as-needed")
        return (*shared, *wraps, *library, "-lm")


def support() -> Support:
    """The support files of this installation.

    Raises:
        LoadError: the package is not installed.
    """
    include = paths.include_folder()
    listed = (include / "usersub" / "wrap.txt").read_text(encoding="ascii").splitlines()
    names = tuple(line.strip() for line in listed if line.strip() and not line.startswith("#"))
    return Support(include, paths.library_path(), names)
