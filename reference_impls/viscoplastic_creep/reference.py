# SPDX-License-Identifier: MIT
"""Creep without a yield point, in arbitrary precision."""


def value(q, props):
    """The traction that belongs to the slip rate."""
    return q.slip_rate / props[0]


_POINTS = [
    {"slip_rate": rate, "pressure": pressure}
    for rate, pressure in [(0.0, 110.0), (3.5, 900.0), (17.0, 0.0), (4e5, 3900.0), (1e-12, 20.0)]
]

CASES = [{"props": [0.04], "points": _POINTS}, {"props": [700.0], "points": _POINTS}]
