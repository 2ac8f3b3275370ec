# SPDX-License-Identifier: MIT
"""Where the parts of an installed usersub lie: headers, library, CMake package, shipped laws."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from usersub.errors import LoadError

_PACKAGE = Path(__file__).resolve().parent


def prefix() -> Path:
    """The folder with `include/` and `lib/`: what a host passes as CMAKE_PREFIX_PATH.

    It is the folder of the compiled part `usersub._core`, which in an editable installation is not
    that of the Python sources.

    Raises:
        LoadError: the package is not installed.
    """
    found = importlib.util.find_spec("usersub._core")
    if found is None or found.origin is None:
        raise LoadError(
            "the compiled part usersub._core is not there; install the package with `pip install .`"
        )
    return Path(found.origin).resolve().parent


def include_folder() -> Path:
    """The folder that holds `usersub/usersub.h` (for `-I`)."""
    return prefix() / "include"


def library_path() -> Path:
    """The shared library `libusersub`.

    Raises:
        LoadError: it is not where the installation puts it.
    """
    path = prefix() / "lib" / "libusersub.so"
    if not path.is_file():
        raise LoadError(f"the library {path} is not there; install the package again")
    return path


def cmake_folder() -> Path:
    """The folder of the CMake package (for `usersub_DIR`)."""
    return prefix() / "lib" / "cmake" / "usersub"


def reference_impls() -> Path:
    """The folder of the shipped laws, one folder a law."""
    inside = _PACKAGE / "reference_impls"
    return inside if inside.is_dir() else _PACKAGE.parent / "reference_impls"
