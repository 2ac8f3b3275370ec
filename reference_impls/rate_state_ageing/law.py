# SPDX-License-Identifier: MIT
"""Rate and state friction, ageing law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin."""

import usersub
from usersub.lift import aged, log_scaled


@usersub.coefficient(props=7, states=1)
def rate_state_ageing(slip_rate, time_increment, state, props):
    start = state[0] if state[0] > 0.0 else props[5]
    theta = aged(start, slip_rate, time_increment, props[4])
    state[0] = theta
    rate = max(slip_rate, props[6])
    mu = props[0] + props[1] * log_scaled(1.0, rate, props[3])
    return max(mu + props[2] * log_scaled(props[3], theta, props[4]), 0.0)
