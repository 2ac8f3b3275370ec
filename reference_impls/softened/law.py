# SPDX-License-Identifier: MIT
"""Coulomb friction whose elastic slip has a given stiffness; props: coefficient, slope of shear
stress over elastic slip. vectors: elastic slip."""

import math

import usersub
from usersub.lift import real, tiny

#: An elastic slip that was left at its limit is rounded: at rest its tangent is that of stick.
ROUNDED = 1.0 + 4.0 * 2.220446049250313e-16


@usersub.traction(props=2, vectors=1)
def softened(motion, pressure, vectors, props):
    strength, slope = props[0] * pressure, props[1]
    x, y = vectors[0, 0] + motion[0], vectors[0, 1] + motion[1]
    length = math.hypot(x, y)
    if not real(strength) > slope * tiny(props):  # zero, but it grows with the pressure
        strength = strength - real(strength)
    if slope * length < strength:
        vectors[0, 0], vectors[0, 1] = x, y
        return slope * x, slope * y
    reach = length if length > 0 else 1.0  # no length: no strength either
    first, second = strength * (x / reach), strength * (y / reach)
    if strength > 0.0 and slope * length <= strength * ROUNDED:
        first = slope * x + (real(first) - slope * real(x))
        second = slope * y + (real(second) - slope * real(y))
    vectors[0, 0], vectors[0, 1] = first / slope, second / slope
    return first, second
