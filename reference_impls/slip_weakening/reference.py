# SPDX-License-Identifier: MIT
"""Linear slip weakening in arbitrary precision."""

from mpmath import mpf


def value(q, props):
    """The coefficient and the accumulated slip."""
    mus, mud, distance = props
    slip = q.state[0] + q.slip_increment
    return mus - (mus - mud) * min(slip / distance, mpf(1)), (slip,)


def _points(*slips):
    """Points by slip at the start and slip rate."""
    return [{"state": [s], "slip_rate": v, "pressure": 110.0 + v} for s, v in slips]


CASES = [
    {
        "props": [0.677, 0.525, 0.4],
        "points": _points(
            (0.0, 0.0), (0.0, 1e-9), (0.0, 1.0), (0.125, 0.5), (0.3, 0.375), (0.3999, 0.0),
            (0.4, 0.0), (0.4, 1.0), (0.3, 4e3), (1e5, 3.5), (0.0, 1e12),
        ),
    },
    {"props": [0.1, 0.45, 1e-5], "points": _points((0.0, 1e-5), (2e-6, 1e-6), (9e-6, 1e-5))},
    {"props": [0.5, 0.0, 2.0], "points": _points((0.0, 1.0), (1.75, 0.96875), (2.0, 0.0))},
]  # fmt: skip
