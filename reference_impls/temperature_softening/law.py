# SPDX-License-Identifier: MIT
"""A coefficient that falls with the temperature; props: form (1 power, 2 exponential), coefficient
when cold and when hot, temperatures of both, exponent."""

import usersub
from usersub.lift import decay_of_power, drop_of_power


@usersub.coefficient(props=6)
def temperature_softening(temperature, props):
    hot, fall = props[2], props[1] - props[2]
    if props[0] == 1:
        share = drop_of_power(temperature, props[3], props[4], props[5])
    else:
        share = decay_of_power(temperature, props[3], props[4], props[5])
    return hot + fall * share
