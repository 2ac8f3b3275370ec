# SPDX-License-Identifier: MIT
"""Coefficient that decays with the accumulated slip; props: static, dynamic, distance."""

import usersub
from usersub.lift import bounded_exp


@usersub.coefficient(props=3, states=1)
def slip_weakening_exponential(slip_increment, state, props):
    state[0] = state[0] + slip_increment
    return props[1] + (props[0] - props[1]) * bounded_exp(-state[0] / props[2])
