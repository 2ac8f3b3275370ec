# SPDX-License-Identifier: MIT
"""Values and derivatives of a law function for given quantities, outside of any interface."""

from __future__ import annotations

import difflib
from typing import Any

from usersub.errors import ContractError
from usersub.lift.description import (
    ARGUMENTS,
    BRISTLE,
    BRISTLE_ARGUMENTS,
    BRISTLE_VARIABLES,
    VARIABLES,
)
from usersub.lift.kernels import Parts

_ARRAYS = ("fields", "state", "vectors", "props")


def value(parts: Parts, quantities: dict[str, Any], compiled: bool) -> Any:
    """What the law returns, without derivatives of its own."""
    found = _callable(parts, "value", compiled)(*_arguments(parts, quantities))
    return tuple(float(x) for x in found) if isinstance(found, tuple) else float(found)


def derivatives(parts: Parts, quantities: dict[str, Any], compiled: bool) -> Any:
    """Value and derivatives by name."""
    found = _callable(parts, "evaluate", compiled)(*_arguments(parts, quantities))
    law = parts.law
    names = BRISTLE_VARIABLES if law.kind == BRISTLE else VARIABLES
    known = law.variables

    def by_name(numbers: Any) -> dict[str, float]:
        return {n: float(x) for n, x in zip(names, numbers, strict=True) if n in known}

    if law.anisotropic or law.kind == BRISTLE:
        return (float(found[0]), float(found[1])), (by_name(found[2]), by_name(found[3]))
    return float(found[0]), by_name(found[1:])


def _callable(parts: Parts, name: str, compiled: bool) -> Any:
    function = getattr(parts, name)
    if not compiled:
        return function
    from numba import njit
    from numba.core.errors import TypingError

    from usersub.lift.compiling import explain, tell

    machine = _machine.get(id(function))
    if machine is None:

        def call(*arguments: Any) -> Any:
            return function(*arguments)

        tell(call)  # type: ignore[arg-type]
        machine = _machine[id(function)] = njit(error_model="numpy")(call)

    def explained(*arguments: Any) -> Any:
        try:
            return machine(*arguments)
        except TypingError:
            explain(parts, "double")
            raise

    return explained


#: Compiled calls by the identity of a call, which `compiling` keeps.
_machine: dict[int, Any] = {}


def _arguments(parts: Parts, quantities: dict[str, Any]) -> list[Any]:
    """The quantities in the order of the calls; zero for those that are not given."""
    import numpy as np

    law = parts.law
    known = BRISTLE_ARGUMENTS if law.kind == BRISTLE else ARGUMENTS
    for name in quantities:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1, cutoff=0.0)
            raise ContractError(
                f"law '{law.name}' has no quantity '{name}'; did you mean '{near[0]}'?"
            )
    given: dict[str, Any] = dict.fromkeys(known, 0.0) | quantities
    given["props"] = np.asarray(quantities.get("props", ()), dtype=float)
    shapes = {
        "state": (parts.scalars(given["props"]),),
        "vectors": (parts.vectors(given["props"]), 2),
    }
    for name in ("state", "vectors"):
        if name in known:
            given[name] = quantities.get(name, np.zeros(shapes[name]))
            if np.shape(given[name]) != shapes[name]:
                raise ContractError(
                    f"law '{law.name}': {name} has the shape {np.shape(given[name])}, expected "
                    f"{shapes[name]}"
                )
            if not isinstance(given[name], np.ndarray):
                given[name] = np.array(given[name], dtype=float)
    given["fields"] = np.asarray(quantities.get("fields", ()), dtype=float)
    order = [n for n in known if n not in (*_ARRAYS, "motion")]
    numbers = {n: float(given[n]) for n in order}
    if law.kind == BRISTLE:
        motion = quantities.get("motion", (0.0, 0.0))
        numbers |= {"motion_1": float(motion[0]), "motion_2": float(motion[1])}
        first = ["motion_1", "motion_2"]
        known = (*first, *(n for n in known if n != "motion"))
    return [given[n] if n in _ARRAYS else numbers[n] for n in known]
