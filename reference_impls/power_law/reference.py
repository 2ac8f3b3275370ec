# SPDX-License-Identifier: MIT
"""Product of powers in arbitrary precision."""


def value(q, props):
    """The coefficient."""
    factor, *rest = props
    given = (q.pressure, q.slip_rate, q.temperature)
    for x, exponent, floor in zip(given, rest[:3], rest[3:], strict=True):
        factor *= max(x, floor) ** exponent
    return factor


_POINTS = [
    {"pressure": pressure, "slip_rate": rate, "temperature": temperature}
    for pressure, rate, temperature in [
        (110.0, 3.5, 60.0), (900.0, 0.0, 115.0), (2e9, 120.0, 300.0), (0.0, 4000.0, 80.0),
        (5.0, 1e-3, 20.0), (17.0, 17.0, -40.0), (1e20, 1e20, 1e20), (0.3, 1e-20, 1400.0),
    ]
]  # fmt: skip

CASES = [
    {"props": [0.8, -0.13, -0.07, 0.21, 5.0, 1e-3, 20.0], "points": _POINTS},
    {"props": [1e-4, 0.5, -1.0, 2.0, 1e-6, 1e-9, 1e-3], "points": _POINTS[:5]},
    {"props": [0.17, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "points": _POINTS},
    {"props": [0.0, -0.2, 0.3, -0.1, 1.0, 2.0, 3.0], "points": _POINTS},
]
