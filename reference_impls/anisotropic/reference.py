# SPDX-License-Identifier: MIT
"""Two constant coefficients."""


def value(q, props):
    """Both coefficients, whatever the point does."""
    return props[0], props[1]


_POINTS = [{"pressure": 110.0}, {"slip_rate": 3.5, "pressure": 900.0}, {"pressure": 0.0}]

CASES = [{"props": props, "points": _POINTS} for props in ([0.15, 0.4], [0.3, 0.0], [0.2, 0.2])]
