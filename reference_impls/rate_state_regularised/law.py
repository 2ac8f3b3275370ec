# SPDX-License-Identifier: MIT
"""Rate and state friction, ageing law, regularised at rest; props: f0, a, b, V0, Dc, theta0."""

import usersub
from usersub.lift import aged, asinh_rate, log_scaled


@usersub.coefficient(props=6, states=1)
def rate_state_regularised(slip_rate, time_increment, state, props):
    start = state[0] if state[0] > 0.0 else props[5]
    theta = aged(start, slip_rate, time_increment, props[4])
    state[0] = theta
    exponent = (props[0] + props[2] * log_scaled(props[3], theta, props[4])) / props[1]
    return props[1] * asinh_rate(slip_rate, 2.0 * props[3], exponent)
