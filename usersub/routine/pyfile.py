# SPDX-License-Identifier: MIT
"""Loading a user's Python file: run it as a module of its own and collect its routines."""

from __future__ import annotations

import hashlib
import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from usersub.errors import CompileError, Error, LoadError
from usersub.routine.routine import Routine, RoutineMaker


def load_python(path: str | Path, generation: str | None = None) -> dict[str, Routine]:
    """Runs the file and returns its routines by interface name.

    Routines that the file defines count, those of its law functions included; if it defines none,
    those that it imports. A law function's FRIC_COEF is made for `generation`. The file may
    import modules of its own folder; these are private to it, as in a program of its own.

    Raises:
        LoadError: the file cannot be read or run, or has no routine, or two for one interface.
        CompileError: a syntax error, with file and line.
        AbiError: a function does not fit its interface.
    """
    file = Path(path).expanduser().resolve()
    module = _run(file)
    found: dict[int, Routine | RoutineMaker] = {
        id(value): value
        for value in vars(module).values()
        if isinstance(value, Routine | RoutineMaker)
    }
    own = [r for r in found.values() if r.origin.rpartition(":")[0] == str(file)]
    routines: dict[str, Routine] = {}
    for routine in _routines(own or list(found.values()), generation):
        name = routine.interface.name
        if name in routines:
            raise LoadError(
                f"{path} defines {name.upper()} twice: '{routines[name].name}' "
                f"({routines[name].origin}) and '{routine.name}' ({routine.origin})"
            )
        routines[name] = routine
    if not routines:
        raise LoadError(
            f"{path} has no routine; decorate a function with @usersub.fric, @usersub.fric_coef, "
            "@usersub.vfric, @usersub.vfriction, @usersub.vfric_coef, or a law function with "
            "@usersub.coefficient, @usersub.strength, @usersub.traction"
        )
    return routines


def _routines(found: list[Routine | RoutineMaker], generation: str | None) -> Iterator[Routine]:
    """The routines, and those behind every interface of a law function."""
    for each in found:
        if isinstance(each, Routine):
            yield each
            continue
        for name in each.interfaces:
            yield each.behind(name, generation=generation if name == "fric_coef" else None)


def _run(file: Path) -> ModuleType:
    """Runs the file as a fresh module; nothing is written beside it."""
    try:
        source = importlib.util.decode_source(file.read_bytes())
        code = compile(source, str(file), "exec", dont_inherit=True)
    except OSError as error:
        raise LoadError(f"{file} cannot be read: {error.strerror}") from error
    except SyntaxError as error:
        raise CompileError(f"{file}:{error.lineno or 1}: {error.msg}") from error
    except ValueError as error:
        raise CompileError(f"{file}:1: {error}") from error
    # A name of its own: two files called law.py do not meet, and classes of the file find it.
    digest = hashlib.sha256(str(file).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    name = f"usersub_file_{file.stem}_{digest}"
    module = ModuleType(name)
    module.__file__ = str(file)
    before = sys.modules.get(name)
    sys.modules[name] = module
    try:
        with _private_imports(file.parent):
            exec(code, module.__dict__)
    except BaseException as error:
        if before is None:
            del sys.modules[name]
        else:
            sys.modules[name] = before
        if isinstance(error, Error) or not isinstance(error, Exception | SystemExit):
            raise
        raise LoadError(
            f"{_place(error, file)}: running the file failed: {type(error).__name__}: {error}"
        ) from error
    return module


@contextmanager
def _private_imports(folder: Path) -> Iterator[None]:
    """Modules of `folder` can be imported, and are forgotten afterwards by everybody else."""
    known = {name.partition(".")[0] for name in sys.modules}
    no_bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    try:
        yield
    finally:
        sys.dont_write_bytecode = no_bytecode
        if str(folder) in sys.path:
            sys.path.remove(str(folder))
        for name in list(sys.modules):
            top = name.partition(".")[0]
            if top not in known and (
                (folder / f"{top}.py").is_file() or (folder / top / "__init__.py").is_file()
            ):
                del sys.modules[name]


def _place(error: BaseException, file: Path) -> str:
    """Line of the file where the error left it, as "file:line"."""
    line, trace = 1, error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(file):
            line = trace.tb_lineno
        trace = trace.tb_next
    return f"{file}:{line}"
