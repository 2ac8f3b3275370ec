# SPDX-License-Identifier: MIT
"""Machine code of law functions: what numba is told before, and in which words it fails."""

from __future__ import annotations

import re
from collections.abc import Callable
from types import FunctionType
from typing import Any

from usersub.errors import CompileError
from usersub.lift.description import BRISTLE
from usersub.lift.kernels import Parts
from usersub.lift.stand_in import is_helper, references
from usersub.routine.routine import Entry

#: Sentences of our own among the words of numba.
_OURS = re.compile(r"TypingError: (?P<words>.+)\n\s*raised from [^\n]*machine")

_registered: dict[int, Any] = {}


class Prepared:
    """Makes an entry after numba has been told of the functions that a law calls."""

    def __init__(self, make: Callable[[str], Entry], parts: Parts, function: FunctionType):
        self._make, self._parts, self._function = make, parts, function

    def __call__(self, precision: str) -> Entry:
        tell(self._function)
        try:
            return self._make(precision)
        except CompileError as error:
            explain(self._parts, precision)
            raise error


def tell(function: FunctionType) -> None:
    """Tells numba of every function that `function` reaches."""
    from numba.extending import overload

    from usersub.lift import machine  # noqa: F401 - tells numba of duals
    from usersub.routine.compiled import error_model

    waiting = [function]
    while waiting:
        for value in references(waiting.pop()):
            if not is_helper(value) or id(value) in _registered:
                continue
            # Kept here, so that the number of the object stays its own.
            _registered[id(value)] = value
            original = getattr(value, "stands_for", value)
            options = {"boundscheck": True, "error_model": error_model(original)}
            if original is not value:
                # All of the law in one function: the compiler treats it with derivatives exactly
                # as without.
                options["forceinline"] = True
            overload(value, jit_options=options, strict=False)(_always(original))
            waiting.append(original)


def _always(function: Callable) -> Callable:
    return lambda *arguments: function


def explain(parts: Parts, precision: str) -> None:
    """Raises a CompileError that tells what is wrong with the law, if the law alone is wrong."""
    from numba import njit, types
    from numba.core.errors import NumbaError

    from usersub.lift.machine import DualArrayType, is_value
    from usersub.lift.machine_dual import DualType
    from usersub.routine.compiled import OPTIONS, error_model, shortened

    law = parts.law
    count = len(law.variables) if precision == "double" and law.derivatives == "dual" else 0
    real: Any = types.float64 if precision == "double" else types.float32
    number = DualType(count) if count else real
    state = [
        DualArrayType(count, d) if count else types.Array(real, d, "C" if d == 2 else "A")
        for d in (1, 2)
    ]
    fixed: dict[str, Any] = {
        "props": types.Array(real, 1, "C", readonly=True),
        "fields": types.Array(real, 1, "C"),
        "state": state[0],
        "vectors": state[1],
        "motion": types.UniTuple(number, 2),
        "time_increment": real,
    }
    arguments = tuple(fixed.get(name, number) for name in law.arguments)
    where, words = law.origin, ""
    dispatcher: Any = njit(**{**OPTIONS, "error_model": error_model(law.function)})(law.function)
    try:
        dispatcher.compile(arguments)
    except NumbaError as error:
        where, words = shortened(str(error), law.function)
        ours = _OURS.search(re.sub(r"\x1b\[[0-9;]*m", "", str(error)))
        words = ours["words"] if ours else words
    else:
        returned = dispatcher.overloads[arguments].signature.return_type
        words = _wrong_shape(law, returned, is_value)
    if words:
        raise CompileError(f"{where}: {law.kind} law '{law.name}': {words}")


def _wrong_shape(law: Any, returned: Any, is_value: Callable[[Any], bool]) -> str:
    """What is wrong with the type that the law returns; "" if nothing is."""
    from usersub.lift import primitives
    from usersub.lift.machine import is_four, is_pair, told

    two = law.anisotropic or law.kind == BRISTLE
    if law.derivatives == "own":
        expected = primitives.OWN_PAIRS if two else primitives.OWN
        fits = getattr(returned, "count", 0) == 2 and (
            is_pair(returned[0]) and all(map(is_four, returned[1]))
            if two
            else is_value(returned[0]) and is_four(returned[1])
        )
    else:
        expected = primitives.PAIR if two else primitives.SINGLE
        fits = is_pair(returned) if two else is_value(returned)
    return "" if fits else primitives.RETURNS.format(told(returned), expected)
