# SPDX-License-Identifier: MIT
"""Rate and state friction, slip law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin."""

import math

import usersub

#: From here on x, the slip over Dc, is large: theta is counted from its steady state.
_LARGE = 0.7

#: Smallest and largest normal number.
TINY, HUGE = 2.2250738585072014e-308, 1.7976931348623157e308


@usersub.coefficient(props=7, states=1)
def rate_state_slip(slip_rate, time_increment, state, props):
    start = state[0] if state[0] > 0.0 else props[5]
    x = slip_rate * time_increment / props[4]
    rate = max(slip_rate, props[6])
    distance = math.log(rate) + math.log(start / props[4])  # from the steady state, in logarithms
    if TINY <= rate * (start / props[4]) <= HUGE:
        distance = math.log(rate * (start / props[4]))
    if x < _LARGE:
        theta = start * math.exp(distance * math.expm1(-x))
    else:
        theta = props[4] / rate * math.exp(distance * math.exp(-x))
    theta = max(theta, TINY)  # 0 was never set
    state[0] = theta
    mu = props[0] + props[1] * math.log(rate / props[3])
    return max(mu + props[2] * math.log(props[3] * (theta / props[4])), 0.0)
