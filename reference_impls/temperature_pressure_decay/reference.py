# SPDX-License-Identifier: MIT
"""Decay between coefficients linear in temperature and pressure, in arbitrary precision."""

from mpmath import exp


def value(q, props):
    """The coefficient."""
    static = props[0] * q.temperature + props[1] * q.pressure
    kinetic = props[2] * q.temperature + props[3] * q.pressure
    share = exp(-props[4] * q.slip_rate)
    return max(static * share + kinetic * (1 - share), 0)


_POINTS = [
    {"slip_rate": rate, "pressure": pressure, "temperature": temperature}
    for rate, pressure, temperature in [
        (0.0, 110.0, 60.0), (3.5, 900.0, 115.0), (17.0, 1500.0, 160.0), (120.0, 2400.0, 30.0),
        (4000.0, 3900.0, 280.0), (0.0, 0.0, 0.0), (1e6, 1e-3, 20.0),
    ]
]  # fmt: skip

CASES = [{"props": [8e-4, 2.5e-5, 3e-4, 1e-5, 0.02], "points": _POINTS}]
