# SPDX-License-Identifier: MIT
"""Elastic slip bounded by Coulomb friction, in arbitrary precision."""

from mpmath import sqrt


def update(q, props):
    """Traction, elastic slip and no scalars at the end of the increment."""
    mu, slope = props
    x, y = (e + m for e, m in zip(q.vectors[0], q.motion, strict=True))
    length = sqrt(x * x + y * y)
    share = mu * q.pressure / (slope * length) if slope * length > mu * q.pressure else 1
    elastic = (x * share, y * share)
    return tuple(slope * e for e in elastic), (elastic,), ()


def _path(size):
    """Stick, slip along a turning direction, stick again, less pressure, open, closed again."""
    return [
        {"motion": [0.3 * size, -0.2 * size], "pressure": 800.0},
        {"motion": [0.0, 0.0], "pressure": 600.0},
        {"motion": [9.0 * size, 7.0 * size], "pressure": 1300.0},
        {"motion": [-0.2 * size, 0.1 * size], "pressure": 1300.0},
        {"motion": [-40.0 * size, 3.0 * size], "pressure": 700.0},
        {"motion": [0.1 * size, 0.05 * size], "pressure": 400.0},
        {"motion": [0.2 * size, -0.1 * size], "pressure": 0.0},
        {"motion": [1e-9 * size, 2e-9 * size], "pressure": 900.0},
        {"motion": [1e9 * size, -2e9 * size], "pressure": 900.0},
    ]


CASES = [
    {"props": [0.3, 2e5], "path": _path(1e-3)},
    {"props": [0.0, 40.0], "path": _path(2.0)},
]
