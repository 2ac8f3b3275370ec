# SPDX-License-Identifier: MIT
"""No friction."""

from mpmath import mpf


def value(q, props):
    """The coefficient."""
    return mpf(0)


CASES = [
    {"props": [], "points": [{"pressure": 110.0}, {"slip_rate": 3.5, "pressure": 0.0},
                             {"slip_rate": 4000.0, "pressure": 1e9, "temperature": 70.0}]}
]  # fmt: skip
