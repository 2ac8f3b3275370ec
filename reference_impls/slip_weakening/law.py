# SPDX-License-Identifier: MIT
"""Coefficient that falls linearly with the accumulated slip; props: static, dynamic, distance."""

import usersub


@usersub.coefficient(props=3, states=1)
def slip_weakening(slip_increment, state, props):
    left = (props[2] - state[0]) - slip_increment
    state[0] = state[0] + slip_increment
    # At the corner the derivative is that of further slip: none.
    if left > 0.0:
        mu = props[1] + (props[0] - props[1]) * (left / props[2])
    else:
        mu = props[1]
    return mu
