# SPDX-License-Identifier: MIT
"""From one point function in Python to routines behind the interfaces.

A law is a function of one contact point that returns the coefficient (or the shear traction) and
its derivatives by slip rate, pressure and temperature::

    def coefficient(slip_rate, _pressure, _temperature, props):
        transition = (props[0] - props[1]) * exp_decay(props[2] * slip_rate)
        return props[1] + transition, -props[2] * transition, 0.0, 0.0

    fric, fric_coef, vfric, vfriction, vfric_coef = coefficient_law(coefficient, props=3)

A leading underscore says that a variable is not read: then it is neither fetched nor passed. The
temperature is the mean of both surfaces, 0 where the scene has none. The rules behind each
interface are those of `coefficient_law.h` and `traction_law.h`, their twins for C.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
from collections.abc import Callable

from usersub.routine.python import PythonRoutine, fric, fric_coef, vfric, vfric_coef, vfriction

__all__ = ["coefficient_law", "exp_decay", "traction_law"]

_VARIABLES = ("slip_rate", "pressure", "temperature")

#: exp(-x) is a normal number up to here; beyond it nothing is left that a coefficient could show.
_EXP_BOUND = 700.0
_EXP_LEAST = math.exp(-_EXP_BOUND)

#: What each variable needs of the routine's arguments that can be left out.
_FETCHED = {
    "vfric": {
        "slip_rate": ("dSlipFric",),
        "pressure": ("areaSec", "jConSecid"),
        "temperature": ("tempSec", "tempMain"),
    },
    "vfriction": {
        "slip_rate": ("dSlipFric",),
        "pressure": ("areaCont",),
        "temperature": ("tempSec", "tempMain"),
    },
    "vfric_coef": {
        "slip_rate": ("slipRate",),
        "pressure": ("pressure",),
        "temperature": ("tempAvg",),
    },
    "fric_coef": {
        "slip_rate": ("slipRate",),
        "pressure": ("pressure",),
        "temperature": ("tempAvg",),
    },
    "fric": {"temperature": ("TEMP",)},
}


def _jitable(function: Callable) -> Callable:
    """Lets compiled code call `function`, which itself stays what it is."""
    from numba.extending import register_jitable

    return register_jitable(function)


def exp_decay(x):
    """exp(-x) for x >= 0, without the slow numbers below the normal ones."""
    return math.exp(-x) if x < _EXP_BOUND else _EXP_LEAST


def _ratio(numerator, denominator):
    """Quotient, or zero where there is nothing to divide by."""
    return numerator / denominator if denominator > 0 else 0.0 * numerator


class _Law:
    """What the routines of one law share."""

    def __init__(self, function: Callable, props: int | Callable):
        names = list(inspect.signature(function).parameters)
        if [n.lstrip("_") for n in names] != [*_VARIABLES, "props"]:
            raise TypeError(
                f"the point function {function.__name__} takes {', '.join(names)}; expected are "
                f"{', '.join(_VARIABLES)}, props, with an underscore before what is not read"
            )
        self.point = _jitable(function)
        self.reads = {v: n == v for v, n in zip(_VARIABLES, names, strict=False)}
        self.name = inspect.getmodule(function).__name__ if False else function.__name__
        code = function.__code__
        self.origin = f"{code.co_filename}:{code.co_firstlineno}"
        if isinstance(props, int):
            least = props
            self.enough = _jitable(lambda given: len(given) >= least)
        else:
            self.enough = _jitable(props)
