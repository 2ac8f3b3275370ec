# SPDX-License-Identifier: MIT
"""Prebuilt user code: shared libraries and object files."""

from __future__ import annotations

import ctypes
import os
import re
from pathlib import Path

from usersub.errors import LoadError
from usersub.routine import build, cache, compilers, debuginfo, objects
from usersub.routine.build import Build
from usersub.routine.support import support

SUFFIXES = (".so", ".dylib", ".dll")
OBJECT_SUFFIXES = (".o", ".obj")

_UNRESOLVED = re.compile(r"undefined symbol: (\w+)")


def examine(path: Path, precision: str) -> Build:
    """What a prebuilt library or object file says about itself; an object is linked first.

    Without debug information nothing is known of arguments: `signatures` is empty then.

    Raises:
        LoadError: it is not there, not a library of this machine, or needs unknown symbols.
    """
    if not path.is_file():
        raise LoadError(f"the library {path} is not there")
    contents = objects.read(path)
    target, absent = path, ()
    if path.suffix.lower() in OBJECT_SUFFIXES:
        target, absent = _linked(path)
    return Build(
        library=target,
        source=path,
        language="library",
        precision=precision,
        compiler="",
        flags=(),
        functions=contents.functions,
        signatures=debuginfo.signatures(path, build.interface_symbols()),
        unused={},
        shared=contents.shared,
        writes_units=contents.writes_units,
        absent=absent,
    )


def _linked(path: Path) -> tuple[Path, tuple[str, ...]]:
    base = support()
    compiler = compilers.find("c")
    target = cache.path(path.stem, cache.key("object", *base.link_flags, path.read_bytes()), ".so")
    if target.is_file():
        return target, ()
    with cache.build_folder() as folder:
        part = folder / "main.o"
        part.write_bytes(path.read_bytes())
        return target, build.link(compiler, path, [part], base, target)


def open_library(path: Path, missing: tuple[str, ...] = ()) -> ctypes.CDLL:
    """Loads a library with its names kept to itself and every symbol resolved now.

    Args:
        missing: symbols that a prebuilt library needs from its host. Where they are utility
            routines, libusersub is made visible first: such libraries are not linked with it.

    Raises:
        LoadError: the loader's words, or the symbols that nobody defines.
    """
    try:
        if missing:
            _offer(set(missing))
        return ctypes.CDLL(str(path), mode=os.RTLD_LOCAL | os.RTLD_NOW)
    except OSError as error:
        found = _UNRESOLVED.search(str(error))
        if found:
            raise LoadError(
                f"{path.name} needs {found[1]}, which neither the library, the libraries that it "
                "names, nor usersub defines"
            ) from error
        raise LoadError(f"{path.name} cannot be loaded: {error}") from error


def _offer(names: set[str]) -> None:
    ours = support().library
    if names.intersection(objects.read(ours).functions):
        ctypes.CDLL(str(ours), mode=os.RTLD_GLOBAL | os.RTLD_NOW)


def address(library: ctypes.CDLL, symbol: str) -> int:
    """Address of a function; 0 if the library has none of that name."""
    try:
        function = getattr(library, symbol)
    except AttributeError:
        return 0
    return ctypes.cast(function, ctypes.c_void_p).value or 0
