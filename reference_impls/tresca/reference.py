# SPDX-License-Identifier: MIT
"""A share of the shear yield stress."""


def value(q, props):
    """The critical shear stress, whatever the point does."""
    return props[0] * props[1]


_POINTS = [{"pressure": 110.0}, {"slip_rate": 3.5, "pressure": 900.0}, {"pressure": 1e-9}]

CASES = [{"props": props, "points": _POINTS} for props in ([0.7, 60.0], [1.0, 3e-4], [0.0, 95.0])]
