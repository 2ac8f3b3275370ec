# SPDX-License-Identifier: MIT
"""Wanheim-Bay friction in arbitrary precision, as published."""

from mpmath import acos, exp, pi, sqrt


def value(q, props):
    """The coefficient: shear stress over pressure."""
    factor, k = props
    yield_stress = sqrt(3) * k
    limit = (
        yield_stress * (1 + pi / 2 + acos(factor) + sqrt(1 - factor**2))
        / (sqrt(3) * (1 + sqrt(1 - factor)))
    )  # fmt: skip
    stress = k * (1 - sqrt(1 - factor))
    if q.pressure < limit or factor == 0:
        return stress / limit
    if factor == 1:
        return stress / q.pressure
    share = exp((limit - q.pressure) * stress / (limit * (factor * k - stress)))
    return (stress + (factor * k - stress) * (1 - share)) / q.pressure


_POINTS = [
    {"pressure": p, "slip_rate": 0.75 * k}
    for k, p in enumerate((0.0, 1e-30, 40.0, 150.0, 155.0, 160.0, 400.0, 2e3, 1e30))
]

CASES = [{"props": [factor, 60.0], "points": _POINTS} for factor in (0.6, 1.0, 0.05, 0.97)] + [
    {"props": [1e-12, 3.0], "points": _POINTS[:4]},
    {"props": [0.0, 3.0], "points": _POINTS[:4]},
]
