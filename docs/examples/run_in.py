# SPDX-License-Identifier: MIT
"""Friction that runs in: from the coefficient of fresh surfaces to that of worn ones with the slip.

props: 1 fresh, 2 worn coefficient, 3 distance of running in. State: slip so far.
"""

import math

import usersub


@usersub.coefficient(props=3, states=1)
def run_in(slip_increment, state, props):
    state[0] = state[0] + slip_increment
    return props[1] + (props[0] - props[1]) * math.exp(-state[0] / props[2])
