# SPDX-License-Identifier: MIT
"""Stribeck curve; props: static and kinetic coefficient, Stribeck rate, exponent, viscous part."""

import usersub
from usersub.lift import decay_of_power


@usersub.coefficient(props=5)
def stribeck(slip_rate, props):
    kinetic, fall, viscous = props[1], props[0] - props[1], props[4]
    decay = decay_of_power(slip_rate, 0.0, props[2], props[3])
    return kinetic + fall * decay + viscous * slip_rate
