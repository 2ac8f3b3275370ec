# SPDX-License-Identifier: MIT
"""Rate and state friction, ageing law, its state integrated over the increment by the theta rule;
props: mu0, a, b, V0, Dc, theta0, Vmin, weight (0 explicit Euler, 1/2 trapezoidal rule, 1 implicit
Euler)."""

import usersub
from usersub.lift import log_scaled


@usersub.coefficient(props=8, states=1)
def ageing_theta(slip_rate, time_increment, state, props):
    before = state[0] if state[0] > 0.0 else props[5]
    weight, share = props[7], slip_rate * time_increment / props[4]
    theta = (before * (1.0 - (1.0 - weight) * share) + time_increment) / (1.0 + weight * share)
    state[0] = theta
    rate = max(slip_rate, props[6])
    mu = props[0] + props[1] * log_scaled(1.0, rate, props[3])
    return max(mu + props[2] * log_scaled(props[3], theta, props[4]), 0.0)
