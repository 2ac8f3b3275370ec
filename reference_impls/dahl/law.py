# SPDX-License-Identifier: MIT
"""Dahl friction: a bristle that bends and slips; props: coefficient, stiffness."""

import math

import usersub
from usersub.lift import real, tiny


@usersub.traction(vectors=1, props=2)
def dahl(motion, pressure, vectors, props):
    strength, stiffness = props[0] * pressure, props[1]
    length = math.hypot(motion[0], motion[1])
    first, second = vectors[0, 0], vectors[0, 1]
    if real(strength) > stiffness * tiny(props):
        x = min(stiffness * length / strength, 1e30)
        if x > 0.0:
            kept, reach = math.exp(-x), strength / stiffness * -math.expm1(-x)
            first = first * kept + reach * (motion[0] / length)
            second = second * kept + reach * (motion[1] / length)
        else:
            first = first + motion[0] - x * first
            second = second + motion[1] - x * second
    elif length > 0.0:  # zero, but it grows with the pressure
        reach = (strength - real(strength)) / stiffness
        first, second = reach * (motion[0] / length), reach * (motion[1] / length)
    else:
        first, second = 0.0 * motion[0], 0.0 * motion[1]
    vectors[0, 0], vectors[0, 1] = first, second
    return stiffness * first, stiffness * second
