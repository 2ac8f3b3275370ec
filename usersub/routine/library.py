# SPDX-License-Identifier: MIT
"""Prebuilt user code: shared libraries and object files."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from collections.abc import Callable
from pathlib import Path

from usersub import abi
from usersub.errors import AbiError, LoadError
from usersub.routine import build, cache, compilers, debuginfo, objects, solver
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
    target = path
    absent = tuple(name for name in contents.missing if solver.is_utility(name))
    if path.suffix.lower() in OBJECT_SUFFIXES:
        target, absent = _linked(path, contents.missing)
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
        missing=contents.missing,
    )


def _linked(path: Path, missing: tuple[str, ...]) -> tuple[Path, tuple[str, ...]]:
    """Links an object with the run-time library of its language."""
    base = support()
    language = "c"
    if any(name.startswith("_gfortran_") for name in missing):
        language = "fortran"
    elif any(name.startswith(("__cxa_", "__gxx_", "_ZSt", "_ZNSt")) for name in missing):
        language = "c++"
    compiler = compilers.find(language)
    target = cache.path(path.stem, cache.key("object", *base.link_flags, path.read_bytes()), ".so")
    if target.is_file():
        return target, ()
    with cache.build_folder() as folder:
        part = folder / "main.o"
        part.write_bytes(path.read_bytes())
        return target, build.link(compiler, path, [part], base.link_flags, target)


#: Called with every library that is loaded from now on, if it is not None.
after_open: Callable[[ctypes.CDLL], None] | None = None


def open_library(path: Path) -> ctypes.CDLL:
    """Loads a library of the cache: names kept to itself, every symbol resolved now."""
    try:
        return _opened(ctypes.CDLL(str(path), mode=os.RTLD_LOCAL | os.RTLD_NOW))
    except OSError as error:
        raise LoadError(f"{path.name} cannot be loaded: {error}") from error


def _opened(loaded: ctypes.CDLL) -> ctypes.CDLL:
    if after_open is not None:
        after_open(loaded)
    return loaded


def open_prebuilt(path: Path, missing: tuple[str, ...]) -> ctypes.CDLL:
    """Loads a library that was built without usersub.

    Its calls of utility routines (XIT, GETPARTINFO ...) and of STOP, exit and abort come to
    libusersub.

    Args:
        missing: symbols that the library needs and does not define.

    Raises:
        LoadError: the loader's words, or the symbols that nobody defines.
        AbiError: it was built with the header of other tables.
    """
    ours = support().library
    offered = set(objects.read(ours).functions)
    try:
        if offered.intersection(missing):
            # Libraries that resolve everything when they are opened have to find them then.
            ctypes.CDLL(str(ours), mode=os.RTLD_GLOBAL | os.RTLD_NOW)
        loaded = ctypes.CDLL(str(path), mode=os.RTLD_LOCAL | os.RTLD_LAZY)
    except OSError as error:
        found = _UNRESOLVED.search(str(error))
        if found:
            raise LoadError(_needs(path, [found[1]])) from error
        raise LoadError(f"{path.name} cannot be loaded: {error}") from error
    process = ctypes.CDLL(None)
    nowhere = [
        name
        for name in missing
        if name not in offered
        and not address(loaded, name)
        and not address(process, name)
        # The core lets such calls end with a message, where it can redirect calls.
        and not (sys.platform == "linux" and solver.is_utility(name))
    ]
    if nowhere:
        raise LoadError(_needs(path, nowhere))
    _check_tables(path, loaded)
    _redirect_stops(loaded)
    return _opened(loaded)


def _check_tables(path: Path, loaded: ctypes.CDLL) -> None:
    """Refuses a library that was built with the header of other tables."""
    try:
        found = (ctypes.c_char * 17).in_dll(loaded, "usub_routine_abi_hash").value.decode("ascii")
    except ValueError:
        return  # built without our header, as field code is
    if found != abi.abi_hash():
        raise AbiError(
            f"{path.name} was built with argument tables of hash {found}, but this package has "
            f"{abi.abi_hash()}; build it again"
        )


def _needs(path: Path, names: list[str]) -> str:
    return (
        f"{path.name} needs {', '.join(names)}, which neither the library, the libraries that it "
        "names, nor usersub defines"
    )


def _redirect_stops(loaded: ctypes.CDLL) -> None:
    from usersub.core import ffi, lib

    lib.usub_redirect_stops(ffi.cast("void *", loaded._handle))


def address(library: ctypes.CDLL, symbol: str) -> int:
    """Address of a function; 0 if the library has none of that name."""
    try:
        function = getattr(library, symbol)
    except AttributeError:
        return 0
    return ctypes.cast(function, ctypes.c_void_p).value or 0
