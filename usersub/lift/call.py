# SPDX-License-Identifier: MIT
"""The call of a law function, as an interface makes it: by a fixed argument list, with and without
derivatives.

`value(...)` returns what the law returns, `evaluate(...)` numbers: the value and its four
derivatives, or two values and two tuples of four derivatives of anisotropic and bristle laws. Both
take every quantity, read or not; what is not read is left out of the law's call, so that machine
code does not fetch it. Text, since each law has arguments and seeds of its own.
"""

from __future__ import annotations

from types import FunctionType
from typing import Any

from usersub.lift import primitives
from usersub.lift.description import (
    ARGUMENTS,
    BRISTLE,
    BRISTLE_VARIABLES,
    VARIABLES,
    Count,
    Description,
)
from usersub.lift.stand_in import with_duals

_BRISTLE_LIST = ("motion_1", "motion_2", "time_increment", "pressure", "temperature", "fields",
                 "vectors", "state", "props")  # fmt: skip


def calls(law: Description) -> tuple[FunctionType, FunctionType]:
    """The functions `value` and `evaluate` of a law."""
    lines = [*_value(law), *_evaluate(law)]
    names = ("scratch", "seed", "dual_array", "store", "real", "partial", "number", "pair",
             "with_derivatives", "pairs_with_derivatives")  # fmt: skip
    space: dict[str, Any] = {name: getattr(primitives, name) for name in names}
    space |= {"law": with_duals(law.function), "__name__": __name__}
    if not isinstance(law.states, int) or not isinstance(law.vectors, int):
        from numpy import empty

        space["empty"] = empty
    exec("\n".join(lines), space)
    return space["value"], space["evaluate"]


def _parameters(law: Description) -> str:
    return ", ".join(_BRISTLE_LIST if law.kind == BRISTLE else ARGUMENTS)


def _two(law: Description) -> bool:
    return law.anisotropic or law.kind == BRISTLE


def _own(law: Description) -> str:
    return "pairs_with_derivatives" if _two(law) else "with_derivatives"


def _value(law: Description) -> list[str]:
    given = ["(motion_1, motion_2)" if name == "motion" else name for name in law.arguments]
    call = f"law({', '.join(given)})"
    if law.derivatives == "own":
        result = f"{_own(law)}({call})[0]"
    else:
        result = f"{'pair' if _two(law) else 'number'}({call})"
    return [f"def value({_parameters(law)}):", f"    return {result}"]


def _evaluate(law: Description) -> list[str]:
    head = f"def evaluate({_parameters(law)}):"
    variables = law.variables
    if law.derivatives != "dual" or not variables:
        return [head, *_without_duals(law)]
    count = len(variables)
    seeds = {v: f"seed({v}, {k}, {count})" for k, v in enumerate(variables)}
    seeds["motion"] = f"({seeds.get('motion_1')}, {seeds.get('motion_2')})"
    body, after = [], []
    for name, each, numbers in (("vectors", 2, law.vectors), ("state", 1, law.states)):
        if name in law.arguments:
            seeds[name] = f"{name}_duals"
            memory = _memory(name, numbers, each * (count + 1))
            body.append(f"    {name}_duals = dual_array({memory}, {name}, {count})")
            after.append(f"    store({name}_duals, {name})")
    given = [seeds.get(name, name) for name in law.arguments]
    body.append(f"    result = law({', '.join(given)})")
    if _two(law):
        body.append("    first, second = pair(result)")
        tuples = ", ".join(_partials(law, each) for each in ("first", "second"))
        after.append(f"    return float(real(first)), float(real(second)), {tuples}")
    else:
        body.append("    result = number(result)")
        after.append(f"    return (float(real(result)),) + {_partials(law, 'result')}")
    return [head, *body, *after]


def _memory(name: str, count: Count, each: int) -> str:
    """Memory for duals: of a fixed size where the number of state variables is fixed."""
    if isinstance(count, int):
        return f"scratch({count * each})"
    return f"empty({name}.shape[0] * {each})"


def _partials(law: Description, value: str) -> str:
    """The four derivatives of a value; zero by what is not read."""
    by = {v: f"partial({value}, {k})" for k, v in enumerate(law.variables)}
    every = BRISTLE_VARIABLES if law.kind == BRISTLE else VARIABLES
    return f"({', '.join(by.get(v, '0.0') for v in every)})"


def _without_duals(law: Description) -> list[str]:
    """Body of `evaluate` where the law gives its own derivatives or none."""
    given = ["(motion_1, motion_2)" if name == "motion" else name for name in law.arguments]
    call = f"law({', '.join(given)})"
    two, own = _two(law), law.derivatives == "own"
    if own:
        lines = [f"    result, by = {_own(law)}({call})"]
    else:
        lines = [f"    result = {'pair' if two else 'number'}({call})"]

    def four(name: str) -> str:
        parts = [f"float({name}[{k}])" if own else "0.0" for k in range(4)]
        return f"({', '.join(parts)})"

    if two:
        results = f"float(result[0]), float(result[1]), {four('by[0]')}, {four('by[1]')}"
        return [*lines, f"    return {results}"]
    return [*lines, f"    return (float(result),) + {four('by')}"]
