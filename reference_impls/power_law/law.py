# SPDX-License-Identifier: MIT
"""Powers of pressure, slip rate and temperature, each at least its floor; props: factor; exponents
of pressure, slip rate, temperature; their floors."""

import usersub
from usersub.lift import product_of_powers


@usersub.coefficient(props=7)
def power_law(slip_rate, pressure, temperature, props):
    p, v, t = max(pressure, props[4]), max(slip_rate, props[5]), max(temperature, props[6])
    return product_of_powers(props[0], p, props[1], v, props[2], t, props[3])
