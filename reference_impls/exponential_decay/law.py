# SPDX-License-Identifier: MIT
"""Exponential decay from a static to a kinetic coefficient; props: static, kinetic, decay."""

import math

import usersub
from usersub.lift import bounded_exp


@usersub.coefficient(props=3)
def exponential_decay(slip_rate, props):
    fall, reach = props[0] - props[1], -props[2] * slip_rate
    if fall < 0:  # the same from the other end, where nothing cancels
        return props[0] + fall * math.expm1(reach)
    return props[1] + fall * bounded_exp(reach)
