# SPDX-License-Identifier: MIT
"""Coulomb friction in arbitrary precision."""


def value(q, props):
    """The coefficient, whatever the point does."""
    return props[0]


CASES = [
    {"props": [mu], "points": [{"pressure": 110.0}, {"slip_rate": 3.5, "pressure": 900.0},
                               {"slip_rate": 4000.0, "pressure": 2.5e-3, "temperature": 70.0}]}
    for mu in (0.15, 0.0)
]  # fmt: skip
