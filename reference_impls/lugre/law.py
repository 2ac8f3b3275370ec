# SPDX-License-Identifier: MIT
"""LuGre friction: a bristle with damping, Stribeck curve and viscous friction.

props: mus, muk, vs, delta, sigma0, sigma1, sigma2.
"""

import math

import usersub
from usersub.lift import real, stribeck, tiny


@usersub.traction(vectors=1, props=7)
def lugre(motion, time_increment, pressure, vectors, props):
    stiffness = props[4]
    per_time = 1.0 / time_increment if time_increment > 0.0 else 0.0
    length = math.hypot(motion[0], motion[1])
    strength = pressure * stribeck(length * per_time, props[0], props[1], props[2], props[3])
    first, second = vectors[0, 0], vectors[0, 1]
    first_rate, second_rate = 0.0 * motion[0], 0.0 * motion[1]
    if real(strength) > stiffness * tiny(props):
        x = min(stiffness * length / strength, 1e30)
        kept = math.exp(-x)
        first_rate = kept * per_time * (motion[0] - x * first)
        second_rate = kept * per_time * (motion[1] - x * second)
        if x > 0.0:
            reach = strength / stiffness * -math.expm1(-x)
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
    viscous = props[6] * per_time
    return (
        stiffness * first + props[5] * first_rate + viscous * motion[0],
        stiffness * second + props[5] * second_rate + viscous * motion[1],
    )
