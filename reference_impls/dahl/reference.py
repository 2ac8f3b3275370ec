# SPDX-License-Identifier: MIT
"""Dahl friction in arbitrary precision: the solution of its differential equation."""

from mpmath import exp, mpf, sqrt


def update(q, props):
    """Traction, bristle, no scalar state."""
    mu, sigma = props
    limit = mu * q.pressure / sigma
    length = sqrt(q.motion[0] ** 2 + q.motion[1] ** 2)
    z = q.vectors[0]
    if limit <= 0:
        z = (mpf(0), mpf(0))
    elif length > 0:
        share = exp(-length / limit)
        steady = [limit * x / length for x in q.motion]
        z = tuple(s + (b - s) * share for s, b in zip(steady, z, strict=True))
    return tuple(sigma * b for b in z), (z,), ()


#: At rest the derivative depends on the direction of the motion that follows.
_REST = {"no_derivative": ["motion 1", "motion 2"]}


def _path(*increments):
    return [
        {"motion": m, "pressure": p} | (_REST if m == (0.0, 0.0) else {}) for m, p in increments
    ]


CASES = [
    {  # pre-sliding, slip, reversal, turns, very short and very long, rest
        "props": [0.5, 1e3],
        "path": _path(
            ((1e-4, 0.0), 4.0), ((2e-4, -1e-4), 4.0), ((3e-3, 1e-3), 4.0), ((-5e-4, 2e-4), 3.0),
            ((0.0, 0.0), 3.0), ((-1e-12, 3e-12), 3.0), ((0.0, 2e-3), 5.0), ((-40.0, 1.0), 5.0),
            ((1e-3, 1e-3), 0.5), ((1e-4, 0.0), 20.0),
        ),
    },
    {  # the pressure goes and comes back
        "props": [0.3, 2e5],
        "path": _path(
            ((1e-5, 2e-5), 30.0), ((1e-6, 0.0), 1e-9), ((1e-5, 1e-5), 0.0), ((0.0, 0.0), 0.0),
            ((1e-6, -2e-6), 30.0),
        ),
    },
    {"props": [0.4, 1e8], "path": _path(((1e-30, 0.0), 1e-3), ((1e6, -1e6), 2.0))},
]  # fmt: skip
