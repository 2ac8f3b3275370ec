# SPDX-License-Identifier: MIT
"""Exponential decay in arbitrary precision."""

from mpmath import exp


def value(q, props):
    """The coefficient."""
    mus, muk, dc = props
    return muk + (mus - muk) * exp(-dc * q.slip_rate)


_RATES = (0.0, 1e-9, 3.5, 17.0, 120.0, 4000.0, 1e7)
_POINTS = [{"slip_rate": v, "pressure": 110.0 + 3.0 * v} for v in _RATES]

CASES = [
    {"props": [0.15, 0.05, 0.01], "points": _POINTS},
    {"props": [0.1, 0.4, 0.02], "points": _POINTS},
    {"props": [0.3, 0.2, 0.0], "points": _POINTS},
]
