# SPDX-License-Identifier: MIT
"""Coulomb friction with a limit of the shear stress, in arbitrary precision."""


def value(q, props):
    """The coefficient: the smaller of both shear stresses over the pressure."""
    mu, limit = props
    if mu * q.pressure < limit:
        return mu
    return limit / q.pressure


# 2048 and 0.25 * 2048 are on the corner exactly: there the limit counts
_PRESSURES = (0.0, 1e-30, 3.5, 2047.75, 2048.0, 2048.5, 9e3, 1e30)
_POINTS = [{"pressure": p, "slip_rate": 0.75 * k} for k, p in enumerate(_PRESSURES)]

CASES = [
    {"props": [0.25, 512.0], "points": _POINTS},
    {"props": [0.3, 1e-20], "points": _POINTS},
    {"props": [0.0, 70.0], "points": _POINTS},
]
