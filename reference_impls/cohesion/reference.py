# SPDX-License-Identifier: MIT
"""Coulomb friction with cohesion."""


def value(q, props):
    """The critical shear stress."""
    return props[0] + props[1] * q.pressure


_PRESSURES = (0.0, 1e-30, 3.5, 110.0, 9e3, 1e30)
_POINTS = [{"pressure": p, "slip_rate": 0.75 * k} for k, p in enumerate(_PRESSURES)]

CASES = [{"props": props, "points": _POINTS} for props in ([12.0, 0.3], [0.0, 0.2], [5.0, 0.0])]
