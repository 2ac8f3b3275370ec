# SPDX-License-Identifier: MIT
"""Norton-Hoff friction, a power of the slip rate; props: consistency, exponent, rate below which
the traction becomes linear."""

import math

import usersub
from usersub.lift import product_of_powers


@usersub.traction(props=3)
def norton_hoff(slip_rate, props):
    n, length = props[1], math.hypot(slip_rate, props[2])
    if not length > 0:
        return (props[0] if n == 1 else 0.0) * slip_rate
    return product_of_powers(props[0], length, n) * (slip_rate / length)
