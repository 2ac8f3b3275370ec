# SPDX-License-Identifier: MIT
"""Derivatives of the functions that a law may call: one table for Python and for machine code.

A rule gets the arguments `x`, `y`, the value `v` of the function and gives its partial derivatives.
Where a function has a kink, `KINKS` tells the derivative along the direction `px` (and `py`) in
which the arguments move: forward duals move each variable upwards, so each partial derivative is
the one from above.
"""

from __future__ import annotations

import math
from collections.abc import Callable

_LOG_2 = math.log(2.0)
_LOG_10 = math.log(10.0)
_ERF = 2.0 / math.sqrt(math.pi)

#: Below this a quotient of a power by its base has lost digits.
_SMALL = 1e-290


def reciprocal_square(x):
    """1/x²; 0 where x² overflows."""
    return 1.0 / x / x


def square_of_sech(x):
    """1/cosh(x)², without overflow and without cancellation."""
    e = math.exp(-2.0 * abs(x))
    return 4.0 * e / ((1.0 + e) * (1.0 + e))


def power_by_base(x, y, v):
    """Derivative of x**y by x, also where x or x**y is zero."""
    if y == 0.0:
        return 0.0
    if x != 0.0 and abs(v) > _SMALL:
        return y * v / x
    if x == 0.0 and y < 1.0:
        return math.inf
    return y * math.pow(x, y - 1.0)


def power_by_exponent(x, y, v):
    """Derivative of x**y by y."""
    if x > 0.0:
        return v * math.log(x)
    if x == 0.0 and y > 0.0:
        return 0.0
    return math.nan


def arctan2_by_first(x, y, v):
    """Derivative of atan2(x, y) by x."""
    h = math.hypot(x, y)
    return y / h / h


def arctan2_by_second(x, y, v):
    """Derivative of atan2(x, y) by y."""
    h = math.hypot(x, y)
    return -(x / h / h)


#: Functions of one variable: derivative by (x, v).
ONE: dict[str, Callable] = {
    "exp": lambda x, v: v,
    "exp2": lambda x, v: _LOG_2 * v,
    "expm1": lambda x, v: math.exp(x),
    "log": lambda x, v: 1.0 / x,
    "log1p": lambda x, v: 1.0 / (1.0 + x),
    "log2": lambda x, v: 1.0 / (x * _LOG_2),
    "log10": lambda x, v: 1.0 / (x * _LOG_10),
    "sqrt": lambda x, v: 0.5 / v,
    "cbrt": lambda x, v: 1.0 / (3.0 * v * v),
    "sin": lambda x, v: math.cos(x),
    "cos": lambda x, v: -math.sin(x),
    "tan": lambda x, v: 1.0 + v * v,
    "asin": lambda x, v: 1.0 / math.sqrt((1.0 - x) * (1.0 + x)),
    "acos": lambda x, v: -1.0 / math.sqrt((1.0 - x) * (1.0 + x)),
    "atan": lambda x, v: reciprocal_square(math.hypot(1.0, x)),
    "sinh": lambda x, v: math.cosh(x),
    "cosh": lambda x, v: math.sinh(x),
    "tanh": lambda x, v: square_of_sech(x),
    "asinh": lambda x, v: 1.0 / math.hypot(1.0, x),
    "acosh": lambda x, v: 1.0 / math.sqrt((x - 1.0) * (x + 1.0)),
    "atanh": lambda x, v: 1.0 / ((1.0 - x) * (1.0 + x)),
    "erf": lambda x, v: _ERF * math.exp(-(x * x)),
    "erfc": lambda x, v: -_ERF * math.exp(-(x * x)),
    "square": lambda x, v: 2.0 * x,
    "degrees": lambda x, v: 180.0 / math.pi,
    "radians": lambda x, v: math.pi / 180.0,
}

#: Functions of two variables: derivatives by x and by y, of (x, y, v).
TWO: dict[str, tuple[Callable, Callable]] = {
    "pow": (power_by_base, power_by_exponent),
    "atan2": (arctan2_by_first, arctan2_by_second),
    "fmod": (lambda x, y, v: 1.0, lambda x, y, v: -math.trunc(x / y)),
    "mod": (lambda x, y, v: 1.0, lambda x, y, v: -math.floor(x / y)),
}

#: Functions whose derivative is infinite at a point of their domain, with its sign there: a
#: variable that does not move has the derivative zero, not zero times infinity.
INFINITE = {
    **dict.fromkeys(
        ("sqrt", "cbrt", "log", "log2", "log10", "log1p", "asin", "acosh", "atanh", "pow"), 1.0
    ),
    "acos": -1.0,
}


def absolute(x, px):
    """Derivative of |x| where x moves by px."""
    if x > 0.0:
        return px
    return -px if x < 0.0 else abs(px)


def larger(x, y, px, py):
    """Derivative of max(x, y): of the larger one, and where both are equal the larger one."""
    if x == y:
        return max(px, py)
    return py if y > x else px


def smaller(x, y, px, py):
    """Derivative of min(x, y): of the smaller one, and where both are equal the smaller one."""
    if x == y:
        return min(px, py)
    return py if y < x else px


def hypotenuse(x, y, px, py):
    """Derivative of hypot(x, y)."""
    h = math.hypot(x, y)
    return x / h * px + y / h * py if h > 0.0 else math.hypot(px, py)


def sign_copied(x, y, px, py):
    """Derivative of copysign(x, y), for a fixed sign of y."""
    return math.copysign(1.0, y) * absolute(x, px)


#: Functions with kinks: derivative along the direction in which the arguments move.
KINKS_OF_ONE: dict[str, Callable] = {"fabs": absolute}
KINKS_OF_TWO: dict[str, Callable] = {
    "max": larger,
    "min": smaller,
    "hypot": hypotenuse,
    "copysign": sign_copied,
}


def interpolation_slope(x, points, values):
    """Slope of `numpy.interp`, from above at its points."""
    last = len(points) - 1
    if not points[0] <= x < points[last]:
        return 0.0
    low, high = 0, last
    while high - low > 1:
        middle = (low + high) // 2
        if x < points[middle]:
            high = middle
        else:
            low = middle
    return (values[high] - values[low]) / (points[high] - points[low])


#: Steps: nothing of the derivative is left but zero.
STEPS = ("floor", "ceil", "trunc", "sign")

#: Questions, which have no derivative.
TESTS = ("isfinite", "isinf", "isnan")

#: Names of numpy's functions by those of `math`, where they differ.
NUMPY_NAMES = {
    "asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "asinh": "arcsinh",
    "acosh": "arccosh", "atanh": "arctanh", "pow": "power", "max": "maximum", "min": "minimum",
}  # fmt: skip
