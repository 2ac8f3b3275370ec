# SPDX-License-Identifier: MIT
"""Tangential damping."""


def value(q, props):
    """The traction that belongs to the slip rate."""
    return props[0] * q.slip_rate


_RATES = (0.0, 1e-12, 3.5, 120.0, 4e5)
_POINTS = [{"slip_rate": v, "pressure": 30.0 * k} for k, v in enumerate(_RATES)]

CASES = [{"props": [c], "points": _POINTS} for c in (0.7, 300.0, 0.0)]
