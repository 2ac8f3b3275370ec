# SPDX-License-Identifier: MIT
"""Derivatives at kinks: the rule of docs/explanation/derivatives.md, row by row."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub

#: expression in x = slip_rate (at a) and y = pressure (at b): a, b, derivatives by x and y.
#: Each is the one from above: what the expression gains per unit when this variable alone grows.
KINKS = [
    ("max(x, y)", 2.0, 2.0, 1.0, 1.0),
    ("min(x, y)", 2.0, 2.0, 0.0, 0.0),
    ("max(2.0, x)", 2.0, 0.0, 1.0, 0.0),
    ("max(x, 2.0)", 2.0, 0.0, 1.0, 0.0),
    ("min(x, 2.0)", 2.0, 0.0, 0.0, 0.0),
    ("max(0.0, -x)", 0.0, 0.0, 0.0, 0.0),
    ("max(-x, -y)", 1.0, 1.0, 0.0, 0.0),
    ("min(-x, -y)", 1.0, 1.0, -1.0, -1.0),
    ("max(x, y, 2.0)", 2.0, 2.0, 1.0, 1.0),
    ("np.maximum(x, y)", 2.0, 2.0, 1.0, 1.0),
    ("np.minimum(2.0, 3.0 * x)", 2.0 / 3.0, 0.0, 0.0, 0.0),
    ("abs(x - y)", 1.0, 1.0, 1.0, 1.0),
    ("abs(3.0 - x)", 3.0, 0.0, 1.0, 0.0),
    ("math.fabs(x)", 0.0, 0.0, 1.0, 0.0),
    ("np.abs(-2.0 * x)", 0.0, 0.0, 2.0, 0.0),
    ("math.hypot(x, 2.0 * y)", 0.0, 0.0, 1.0, 2.0),
    ("math.copysign(x, -1.0)", 0.0, 0.0, -1.0, 0.0),
    ("math.sqrt(x)", 0.0, 0.0, math.inf, 0.0),
    ("math.sqrt(y + 0.0 * x)", 0.0, 0.0, 0.0, math.inf),
    ("math.sqrt(max(y, 1.0)) + x", 1.0, 0.0, 1.0, 0.0),
    ("x ** 0.5 + y", 0.0, 0.0, math.inf, 1.0),
    ("x ** 1.0", 0.0, 0.0, 1.0, 0.0),
    ("x ** 1.5", 0.0, 0.0, 0.0, 0.0),
    ("x ** y", 0.0, 2.0, 0.0, 0.0),
    ("(x if x < 2.0 else 3.0 * x - 4.0)", 2.0, 0.0, 3.0, 0.0),
    ("(x if x <= 2.0 else 3.0 * x - 4.0)", 2.0, 0.0, 1.0, 0.0),
    ("math.floor(x) + y", 3.0, 0.0, 0.0, 1.0),
    ("x % 2.0", 4.0, 0.0, 1.0, 0.0),
    ("np.fmod(x, y)", 4.0, 2.0, 1.0, -2.0),
    ("x // 2.0", 4.0, 0.0, 0.0, 0.0),
    ("round(x) * y", 2.5, 1.0, 0.0, 2.0),
    ("math.trunc(x) * y", 2.0, 1.0, 0.0, 2.0),
    ("np.clip(x, 1.0, y)", 1.0, 5.0, 1.0, 0.0),
    ("np.clip(x, 1.0, y)", 5.0, 5.0, 0.0, 0.0),
    ("np.clip(x, 1.0, y)", 7.0, 5.0, 0.0, 1.0),
    ("np.where(x < y, 2.0 * x, 3.0)", 1.0, 2.0, 2.0, 0.0),
    ("np.where(x < y, 2.0 * x, 3.0)", 2.0, 2.0, 0.0, 0.0),
    ("np.square(x) + pow(y, 3)", 3.0, 2.0, 6.0, 12.0),
    ("np.sign(x) + y", -2.0, 1.0, 0.0, 1.0),
    ("max((x, 1.0, y)) + min((x, y))", 3.0, 2.0, 1.0, 1.0),
    ("np.interp(x, POINTS, VALUES)", 2.0, 0.0, 5.0, 0.0),
    ("np.interp(x, POINTS, VALUES)", 1.5, 0.0, -2.0, 0.0),
    ("np.interp(x, POINTS, VALUES)", 4.0, 0.0, 0.0, 0.0),
    ("np.interp(x, POINTS, VALUES)", 0.5, 0.0, 0.0, 0.0),
    ("1", 0.5, 0.0, 0.0, 0.0),
    ("math.floor(x)", 0.5, 0.0, 0.0, 0.0),
    ("bounded_exp(-x)", 700.0, 0.0, 0.0, 0.0),
]


def law_of(expression: str) -> usersub.LawFunction:
    space = {"usersub": usersub, "math": math, "np": np}
    space |= {"POINTS": np.array([1.0, 2.0, 4.0]), "VALUES": np.array([3.0, 1.0, 11.0])}
    exec("from usersub.lift import bounded_exp", space)
    exec(
        f"def law(slip_rate, pressure):\n    x, y = slip_rate, pressure\n    return {expression}",
        space,
    )
    return usersub.coefficient(space["law"])


@pytest.mark.parametrize("compiled", [False, True], ids=["interpreter", "machine"])
@pytest.mark.parametrize(("expression", "x", "y", "by_x", "by_y"), KINKS, ids=[k[0] for k in KINKS])
def test_kinks(expression, x, y, by_x, by_y, compiled):
    law = law_of(expression)
    value, by = law.derivatives(slip_rate=x, pressure=y, compiled=compiled)
    assert value == law.value(slip_rate=x, pressure=y, compiled=compiled)
    if expression.startswith("bounded"):
        assert 0.0 <= by["slip_rate"] <= 1e-300 or by["slip_rate"] == -value
        return
    assert (by["slip_rate"], by["pressure"]) == (by_x, by_y)
