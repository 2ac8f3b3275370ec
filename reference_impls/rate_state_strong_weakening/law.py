# SPDX-License-Identifier: MIT
"""Rate and state friction with strong weakening at high rates (flash heating), slip law.

props: f0, a, b, V0, Dc, theta0, fw, Vw, Vmin.
"""

import math

import usersub
from usersub.lift import asinh_rate, log_scaled

#: Smallest and largest normal number.
TINY, HUGE = 2.2250738585072014e-308, 1.7976931348623157e308


def weakening(ratio):
    """(1 + ratio^8)^(-1/8), without overflow."""
    if ratio < 1.0:
        share = (1.0 + ratio**8) ** -0.125
    else:
        share = (1.0 + (1.0 / ratio) ** 8) ** -0.125 / ratio
    return share


@usersub.coefficient(props=9, states=1)
def rate_state_strong_weakening(slip_rate, time_increment, state, props):
    f0, a, b, v0, distance, fw = props[0], props[1], props[2], props[3], props[4], props[6]
    start = state[0] if state[0] > 0.0 else props[5]
    x = min(slip_rate * time_increment / distance, 1e30)
    rate = max(slip_rate, max(props[8], TINY))
    low = max(f0 + (a - b) * log_scaled(1.0, rate, v0), fw)
    steady = fw + (low - fw) * weakening(slip_rate / props[7])
    # psi = f0 + b ln(V0 theta/Dc) decays to that of steady sliding, a ln(2 V0/rate sinh(steady/a))
    size = steady / a
    psi_steady = a * (log_scaled(1.0, v0, rate) + size + math.log(-math.expm1(-2.0 * size)))
    psi = f0 + b * log_scaled(v0, start, distance)
    psi = psi * math.exp(-x) - psi_steady * math.expm1(-x)
    power = (psi - f0) / b
    state[0] = distance / v0 * math.exp(min(max(power, -600.0), 600.0))
    if not 0.0 < state[0] <= HUGE:  # no number in single precision
        state[0] = distance / v0 * math.exp(min(max(power, -70.0), 70.0))
    return a * asinh_rate(slip_rate, 2.0 * v0, psi / a)
