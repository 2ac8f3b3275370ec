# SPDX-License-Identifier: MIT
"""Dahl friction: a bristle that bends and slips; props: coefficient, stiffness."""

import math

import usersub


@usersub.traction(vectors=1, props=2)
def dahl(motion, pressure, vectors, props):
    strength, stiffness = props[0] * pressure, props[1]
    length = math.hypot(motion[0], motion[1])
    first, second = vectors[0, 0], vectors[0, 1]
    if strength > 0.0:
        x = min(stiffness * length / strength, 1e30)
        if x > 0.0:
            kept, reach = math.exp(-x), strength / stiffness * -math.expm1(-x)
            first = first * kept + reach * (motion[0] / length)
            second = second * kept + reach * (motion[1] / length)
        else:
            first = first + motion[0] - length * (stiffness / strength * first)
            second = second + motion[1] - length * (stiffness / strength * second)
    elif length > 0.0:  # zero, but it grows with the pressure
        first = strength / stiffness * (motion[0] / length)
        second = strength / stiffness * (motion[1] / length)
    else:
        first, second = 0.0 * motion[0], 0.0 * motion[1]
    vectors[0, 0], vectors[0, 1] = first, second
    return stiffness * first, stiffness * second
