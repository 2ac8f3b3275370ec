# SPDX-License-Identifier: MIT
"""Entries that numba compiles from a Python function, kept in the cache between processes."""

from __future__ import annotations

import dis
import hashlib
import linecache
import os
import re
import sys
import textwrap
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any

from usersub import abi
from usersub.emit.numba_adapter import adapter_source, is_array
from usersub.errors import CompileError, LoadError
from usersub.routine import cache as code_cache
from usersub.routine import vector_math
from usersub.routine.declaration import Declaration
from usersub.routine.fingerprint import fingerprint
from usersub.routine.routine import BLOCK, FULL, POINTS, Entry
from usersub.routine.vector_math import LIBMVEC

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_PLACE = re.compile(r'^\s*File "(?P<file>[^"]+)", line (?P<line>\d+)')
_NOISE = ("Failed in ", "During:", "<source ", "Enable ", "For more ")
OPTIONS: dict[str, Any] = {
    "boundscheck": True,  # an index beyond its array raises, and never meets foreign memory
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}

#: Operations that give zero, in place of an error, under numba's error model "numpy".
_WHOLE_DIVISIONS = ("//", "//=", "%", "%=")

#: Longest quotation of numba's words in a message.
_WORDS = 600


def compiled_entry(
    declaration: Declaration, precision: str, style: int = BLOCK, vector: str = ""
) -> Entry:
    """Machine code of the function behind its adapter, from the cache or freshly compiled.

    Args:
        declaration: the function and its arguments.
        precision: "double" or "single".
        style: BLOCK, POINTS or FULL.
        vector: where exp, log and pow come from (`vector_math.choice`).

    Raises:
        CompileError: numba refuses the function; the message has file, line and numba's words.
    """
    import numba

    source = adapter_source(declaration.interface, declaration.positions, precision, style)
    law = declaration.law
    options = {**OPTIONS, "error_model": error_model(law)} if law is declaration.function else {}
    if vector:
        options = options or dict(law.targetoptions)
        options["nopython"] = True
        own = vector_math.pipeline(vector)
        law = numba.jit(pipeline_class=own, **options)(declaration.function)
    elif options:
        law = numba.njit(**options)(law)
    file = _cached_source(declaration, source, vector)
    signature = _signature(declaration.interface, style)
    if file is not None:
        try:
            return Entry(*_code(_adapter(source, file, law), signature, style, cached=True))
        except numba.core.errors.NumbaError as error:
            raise _compile_error(declaration, precision, law, error) from error
        except Exception:
            # The cache may be damaged, or hold what this process cannot use: go on without it.
            pass
    try:
        return Entry(*_code(_adapter(source, None, law), signature, style, cached=False))
    except Exception as error:
        raise _compile_error(declaration, precision, law, error) from error


def error_model(function: FunctionType) -> str:
    """ "python" where integers may be divided: `//` and `%` by zero raise then, as uncompiled.

    Elsewhere "numpy": a real division by zero gives infinity, which the driver refuses as a result.
    """
    whole = any(
        step.argrepr in _WHOLE_DIVISIONS if step.opname == "BINARY_OP" else step.argval == "divmod"
        for step in dis.get_instructions(function)
    )
    return "python" if whole else "numpy"


def _code(function: Any, signature: tuple, style: int, cached: bool) -> tuple[int, int, Any]:
    """Address, style and keeper of the compiled adapter."""
    code = _code_class()(function, signature, locals={}, options={"error_model": "numpy"})
    if cached:
        code.enable_caching()
    code.compile()
    return code.address, style, code


@cache
def _code_class() -> type:
    """numba's C callback with every function but the entry private to it.

    numba names functions by module, name and a number that starts anew in each process; two
    cached closures of one name would otherwise share what the linker sees first.
    """
    from numba.core import ccallback

    base: Any = ccallback.CFunc

    class PrivateCode(base):
        def _compile_uncached(self) -> Any:
            result = super()._compile_uncached()
            entries = {result.fndesc.llvm_func_name, result.fndesc.llvm_cfunc_wrapper_name}
            library = result.library
            optimize = library._optimize_final_module

            def private_then_optimize() -> None:
                for function in library._final_module.functions:
                    if not function.is_declaration and function.name not in entries:
                        function.linkage = "internal"
                optimize()

            library._optimize_final_module = private_then_optimize
            return result

    return PrivateCode


def _signature(face: abi.Interface, style: int) -> Any:
    from numba import types

    arguments: tuple = (types.CPointer(types.voidptr),)
    if style == POINTS:
        whole = types.CPointer(types.int32)
        arguments += types.CPointer(types.int64), whole, types.int32, whole
    if style == FULL:
        texts = sum(a.kind == "char" for a in face.args)
        arguments = (types.voidptr,) * len(face.args) + (types.intp,) * texts
    return arguments, types.int32


def _adapter(source: str, file: Path | None, law: Any) -> Any:
    """The Python function `adapter` of the generated source, with `law` as a global."""
    from usersub.routine import numba_tools

    if file is None:
        key = code_cache.key(source)
        name = f"<adapter {key}>"
        linecache.cache[name] = (len(source), None, source.splitlines(keepends=True), name)
    else:
        key, name = file.stem, str(file)
    # The module of the namespace has to be one that another process can import.
    namespace: dict[str, Any] = {"__name__": numba_tools.__name__, "law": law}
    exec(compile(source, name, "exec"), namespace)
    function = namespace["adapter"]
    function.__name__ = function.__qualname__ = f"adapter_{key}"
    return function


def _cached_source(declaration: Declaration, source: str, vector: str) -> Path | None:
    """The adapter's source as a file of the cache; numba keeps the machine code beside it.

    None if the function depends on something that has no value to compare, or if there is no
    cache folder.
    """
    import llvmlite
    import numba

    law = fingerprint(declaration.law)
    if law is None:
        return None
    flags = ("BOUNDSCHECK", "OPT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "DEBUGINFO_DEFAULT")
    key = code_cache.key(
        source, law, abi.abi_hash(), sys.version, numba.__version__, llvmlite.__version__,
        str([getattr(numba.config, flag, None) for flag in flags]), _tools_hash(), vector,
    )  # fmt: skip
    try:
        # Code that calls libmvec must not be loaded before it: it is kept apart.
        home = code_cache.folder() / ("numba-libmvec" if vector == LIBMVEC else "numba")
        home.mkdir(mode=0o700, exist_ok=True)
        file = home / f"{declaration.interface.key}_{key}.py"
        # numba trusts what it compiled for a file of this time and size: write it only once.
        if not file.exists():
            code_cache.put_text(source, file)
    except (OSError, LoadError):
        return None
    return file


@cache
def _tools_hash() -> str:
    """Hash of our own code that ends up in the machine code."""
    folder = Path(__file__).parent
    ours = ("numba_tools.py", "lanes.py", "vector_kernels.py", "vector_math.py")
    files = [Path(__file__), *(folder / n for n in ours), *sorted(folder.parent.glob("lift/*.py"))]
    texts = [file.read_bytes() for file in files]
    return hashlib.sha256(b"".join(texts)).hexdigest()


def _compile_error(
    declaration: Declaration, precision: str, law: Any, error: Exception
) -> CompileError:
    """The error in numba's words, and where: those of the function alone if it fails alone."""
    from numba import types

    arguments = _law_types(declaration, precision)
    where, words = declaration.origin, ""
    try:
        law.compile(arguments)
        returned = law.overloads[arguments].signature.return_type
        if returned not in (types.none, types.void):
            words = f"it returns a value ({returned}); results go into the elements of its arrays"
    except Exception as own:
        error = own
    if not words:
        where, words = shortened(str(error), declaration.function)
    return CompileError(
        f"{where}: numba cannot compile the {declaration.interface.name.upper()} routine "
        f"'{declaration.name}': {words} (with compiled=False it runs uncompiled)"
    )


def _law_types(declaration: Declaration, precision: str) -> tuple:
    """numba's types of what the function gets."""
    from numba import types

    real = types.float64 if precision == "double" else types.float32

    def type_of(arg: abi.Arg) -> Any:
        if arg.kind == "char":
            return types.unicode_type
        if not is_array(arg):
            return real if arg.kind == "real" else types.int64
        dtype, rank = (real if arg.kind == "real" else types.int32), len(arg.shape) or 1
        layout = "F" if rank > 1 else "C"
        array: Any = types.Array
        return array(dtype, rank, layout, readonly=arg.intent == "read")

    return tuple(type_of(declaration.interface.args[i]) for i in declaration.positions)


def shortened(text: str, function: FunctionType) -> tuple[str, str]:
    """Place ("file:line") and reason out of numba's long message about the user's function."""
    file, line = function.__code__.co_filename, function.__code__.co_firstlineno
    reason: list[str] = []
    in_source = False
    for row in _COLOUR.sub("", text).splitlines():
        place = _PLACE.match(row)
        if place:
            in_source = True
            if os.path.abspath(place["file"]) == os.path.abspath(file):
                line = int(place["line"])
        elif not row.strip():
            in_source = in_source and not reason
        elif not in_source and not row.startswith(_NOISE):
            reason.append(row.strip())
    words = " ".join(reason)
    inner = re.search(rf"{re.escape(file)} \((\d+)\)", words)
    if inner:
        line = int(inner[1])
    words = re.split(r"[. ]+(?:There are \d+ candidate|Raised from )", words)[0]
    if "setitem(readonly array" in words:
        words = "it writes to an array that the interface only lets it read"
    if "<class 'function'>" in words:
        words += "; functions that it calls need @numba.njit"
    return f"{file}:{line}", textwrap.shorten(words, _WORDS) or "no reason given"
