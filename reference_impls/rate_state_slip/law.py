# SPDX-License-Identifier: MIT
"""Rate and state friction, slip law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin."""

import math

import usersub
from usersub.lift import log_scaled

#: From here on x, the slip over Dc, is large: theta is counted from its steady state.
_LARGE = 0.7

#: Smallest normal number.
TINY = 2.2250738585072014e-308


@usersub.coefficient(props=7, states=1)
def rate_state_slip(slip_rate, time_increment, state, props):
    start = state[0] if state[0] > 0.0 else props[5]
    x = min(slip_rate * time_increment / props[4], 1e30)
    rate = max(slip_rate, max(props[6], TINY))
    distance = log_scaled(rate, start, props[4])  # from the steady state, in the logarithm
    if x < _LARGE:
        theta = start * math.exp(distance * math.expm1(-x))
    else:
        theta = props[4] / rate * math.exp(distance * math.exp(-x))
    theta = max(theta, TINY)  # 0 was never set
    state[0] = theta
    mu = props[0] + props[1] * log_scaled(1.0, rate, props[3])
    return max(mu + props[2] * log_scaled(props[3], theta, props[4]), 0.0)
