# SPDX-License-Identifier: MIT
"""A hash of all that the machine code of a Python function depends on.

numba's own cache looks at the source file of a function, but not at the functions and constants
of other files that it uses. Here the function's code is followed into every global and closure
value; where one of them cannot be told by value, the function is not cached. Of a function that
numba knows by `overload` the Python function is followed, as `register_jitable` compiles it, or
the function that it `stands_for`.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

#: Modules whose contents are fixed by their version.
_FIXED_MODULES = ("math", "cmath", "numpy", "numba", "operator")

#: Functions that numba does not compile from their Python code, see `usersub.lift.machine`. Their
#: machine code is that of this version of the package.
_PRIMITIVES = "usersub.lift.primitives"

_PLAIN = (type(None), bool, int, float, complex, str, bytes, type(Ellipsis))


class _Unknown(Exception):  # noqa: N818 - never leaves this module
    """A value that cannot be told by value."""


def fingerprint(law: Callable) -> str | None:
    """Hash of a function or numba dispatcher with all it refers to; None if it cannot be told."""
    digest = hashlib.sha256()
    try:
        _value(law, digest.update, set())
    except _Unknown:
        return None
    return digest.hexdigest()


def _value(value: Any, add: Callable, seen: set[int]) -> None:
    """Adds one value; a function that was met before is only named, which ends recursion."""
    kind = type(value)
    if kind in _PLAIN:
        add(f"{kind.__name__} {value!r};".encode())
    elif kind in (tuple, frozenset):
        items = value if kind is tuple else sorted(value, key=repr)
        add(f"{kind.__name__} {len(items)};".encode())
        for item in items:
            _value(item, add, seen)
    elif isinstance(value, CodeType):
        _code(value, add, seen)
    elif isinstance(value, FunctionType):
        _function(value, add, seen)
    elif hasattr(value, "py_func") and hasattr(value, "targetoptions"):
        options = {k: v for k, v in value.targetoptions.items() if isinstance(v, _PLAIN)}
        if len(options) != len(value.targetoptions):
            raise _Unknown
        add(f"compiled {sorted(options.items())!r};".encode())
        _value(value.py_func, add, seen)
    else:
        _library_value(value, add)


def _library_value(value: Any, add: Callable) -> None:
    """Adds a value of numpy, numba or a fixed module."""
    if isinstance(value, ModuleType):
        _fixed(value.__name__)
        add(f"module {value.__name__};".encode())
    elif isinstance(value, BuiltinFunctionType | type) or type(value).__name__ == "ufunc":
        home = getattr(value, "__module__", None) or "numpy"
        if home != "builtins":
            _fixed(home)
        add(f"library {home}.{getattr(value, '__qualname__', None) or value.__name__};".encode())
    elif type(value).__module__.startswith("numba.core.types"):
        add(f"type {value!r};".encode())
    elif type(value).__module__ == "numpy" and hasattr(value, "tobytes"):
        if value.dtype.hasobject:
            raise _Unknown
        order = "F" if getattr(value.flags, "fnc", False) else "C"
        add(f"array {value.dtype.str} {value.shape} {order};".encode())
        add(value.tobytes(order))
    else:
        raise _Unknown


def _is_fixed(module: str) -> bool:
    return module.split(".")[0].lstrip("_") in _FIXED_MODULES


def _fixed(module: str) -> None:
    if not _is_fixed(module):
        raise _Unknown


def _function(function: FunctionType, add: Callable, seen: set[int]) -> None:
    function = getattr(function, "stands_for", function)
    home = function.__module__ or ""
    if home.split(".")[0] in _FIXED_MODULES or home == _PRIMITIVES:
        add(f"library {home}.{function.__qualname__};".encode())
        return
    if id(function) in seen:
        add(f"again {function.__qualname__};".encode())
        return
    seen.add(id(function))
    _code(function.__code__, add, seen)
    _value(function.__defaults__ or (), add, seen)
    _value(tuple(sorted((function.__kwdefaults__ or {}).items())), add, seen)
    for cell in function.__closure__ or ():
        _value(cell.cell_contents, add, seen)
    names = sorted(_names(function.__code__))
    for name in names:
        if name in function.__globals__:
            add(f"global {name};".encode())
            _global(function.__globals__[name], names, add, seen)


def _global(value: Any, names: list[str], add: Callable, seen: set[int]) -> None:
    """Adds a global value; of a module whose version tells nothing, what the code may name."""
    if not isinstance(value, ModuleType) or _is_fixed(value.__name__):
        _value(value, add, seen)
        return
    add(f"module {value.__name__};".encode())
    if id(value) in seen:
        return
    seen.add(id(value))
    for name in names:
        if hasattr(value, name):
            add(f"attribute {name};".encode())
            _global(getattr(value, name), names, add, seen)


def _names(code: CodeType) -> set[str]:
    """Global names of the code and of the functions inside it (and attributes, which are rare)."""
    found = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            found |= _names(constant)
    return found


def _code(code: CodeType, add: Callable, seen: set[int]) -> None:
    add(f"code {code.co_name} {code.co_argcount} {code.co_flags};".encode())
    add(code.co_code)
    for names in (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars):
        add(f"{names!r};".encode())
    # Exceptions raised in the code do not leave the adapter, so line numbers do not matter.
    add(getattr(code, "co_exceptiontable", b""))
    for constant in code.co_consts:
        _value(constant, add, seen)
