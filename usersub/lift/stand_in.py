# SPDX-License-Identifier: MIT
"""Functions with which the interpreter calculates derivatives, and the helpers that a law calls.

`math.exp` and its likes take plain numbers only. A law that is run by the interpreter with duals
therefore runs with other globals: the same code, in which `math`, `max`, `min` and the plain
functions of the user's files stand for twins that know duals. Breakpoints and line numbers are
those of the user's file.
"""

from __future__ import annotations

import builtins
import math
from collections.abc import Callable, Iterator
from types import (
    BuiltinFunctionType,
    CellType,
    CodeType,
    FunctionType,
    ModuleType,
    SimpleNamespace,
)
from typing import Any

from usersub.lift import dual

#: Packages whose functions are no helpers of a law.
_FOREIGN = ("math", "cmath", "numpy", "numba", "operator", "builtins")

#: Module of the functions that `machine` gives to numba itself.
PRIMITIVES = "usersub.lift.primitives"


def is_helper(value: Any) -> bool:
    """Whether a law's global is a function that has to be followed: the user's, or one of ours."""
    if not isinstance(value, FunctionType):
        return False
    home = value.__module__ or ""
    return home.split(".")[0] not in _FOREIGN and home != PRIMITIVES


def names_of(code: CodeType) -> set[str]:
    """Global names (and attributes) in the code and in the functions inside it."""
    found = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            found |= names_of(constant)
    return found


def references(function: FunctionType) -> Iterator[Any]:
    """Values of the globals, of modules' attributes and of the closure that the code names."""
    names = names_of(function.__code__)
    for cell in function.__closure__ or ():
        yield cell.cell_contents
    for name in names & function.__globals__.keys():
        value = function.__globals__[name]
        if isinstance(value, ModuleType) and value.__name__.split(".")[0] not in _FOREIGN:
            yield from (vars(value)[n] for n in names & vars(value).keys())
        else:
            yield value


def _knows_duals(name: str, plain: Callable) -> Callable:
    """The function `name` of `math`, or `max` or `min`, for numbers and for duals."""

    def function(*inputs: Any) -> Any:
        if name in ("max", "min") and len(inputs) == 1:
            inputs = tuple(inputs[0])
        if any(isinstance(x, dual.Dual) for x in inputs):
            if name not in dual.FUNCTIONS:
                from usersub.errors import ContractError

                raise ContractError(dual.refusal(f"math.{name}"))
            return dual.calculate(name, plain, *inputs)
        return plain(*inputs)

    function.__name__ = name
    return function


_MATH = {
    name: _knows_duals(name, value) if isinstance(value, BuiltinFunctionType) else value
    for name, value in vars(math).items()
    if not name.startswith("_")
}
_BY_FUNCTION = {id(getattr(math, name)): value for name, value in _MATH.items() if callable(value)}
_BUILTINS = {name: _knows_duals(name, getattr(builtins, name)) for name in ("max", "min")}


def with_duals(function: FunctionType) -> Callable:
    """A twin of the function that also takes duals; the twin's `stands_for` is the function."""
    return _twin(function, {})


def _twin(function: FunctionType, made: dict[int, Any]) -> Any:
    if id(function) in made:
        return made[id(function)]
    space: dict[str, Any] = {**_BUILTINS, **function.__globals__}
    before = function.__closure__ or ()
    cells = tuple(CellType() for _ in before)
    twin: Any = FunctionType(
        function.__code__, space, function.__name__, function.__defaults__, cells or None
    )
    twin.__kwdefaults__ = function.__kwdefaults__
    twin.__module__ = function.__module__
    twin.stands_for = function
    made[id(function)] = twin
    names = names_of(function.__code__)
    for name in names & function.__globals__.keys():
        space[name] = _exchanged(function.__globals__[name], names, made)
    for cell, old in zip(cells, before, strict=True):
        cell.cell_contents = _exchanged(old.cell_contents, names, made)
    return twin


def _exchanged(value: Any, names: set[str], made: dict[int, Any]) -> Any:
    """What stands for a global of a law that runs with duals."""
    if id(value) in _BY_FUNCTION:
        return _BY_FUNCTION[id(value)]
    if value is math:
        return SimpleNamespace(**_MATH)
    if hasattr(value, "py_func") and isinstance(value.py_func, FunctionType):
        value = value.py_func
    if is_helper(value):
        return _twin(getattr(value, "stands_for", value), made)
    if isinstance(value, ModuleType) and value.__name__.split(".")[0] not in _FOREIGN:
        chosen = {n: _exchanged(vars(value)[n], names, made) for n in names & vars(value).keys()}
        return SimpleNamespace(**{**vars(value), **chosen})
    return value
