# SPDX-License-Identifier: MIT
"""Exponential decay between coefficients that are linear in temperature and pressure;
props: Cs, Ds, Ck, Dk, decay."""

import usersub
from usersub.lift import bounded_exp


@usersub.coefficient(props=5)
def temperature_pressure_decay(slip_rate, pressure, temperature, props):
    at_rest = props[0] * temperature + props[1] * pressure
    sliding = props[2] * temperature + props[3] * pressure
    mu = sliding + (at_rest - sliding) * bounded_exp(-props[4] * slip_rate)
    return mu if mu == 0.0 else max(mu, 0.0)  # at zero the slopes are those of the formula
