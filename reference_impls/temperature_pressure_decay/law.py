# SPDX-License-Identifier: MIT
"""Exponential decay between coefficients that are linear in temperature and pressure;
props: Cs, Ds, Ck, Dk, decay."""

from usersub.laws.lift import bounded_exp, coefficient_law


def temperature_pressure_decay(slip_rate, pressure, temperature, props):
    at_rest = props[0] * temperature + props[1] * pressure
    sliding = props[2] * temperature + props[3] * pressure
    share = bounded_exp(-props[4] * slip_rate)
    return (
        sliding + (at_rest - sliding) * share,
        -props[4] * (at_rest - sliding) * share,
        props[3] + (props[1] - props[3]) * share,
        props[2] + (props[0] - props[2]) * share,
    )


fric, fric_coef, vfric, vfriction, vfric_coef = coefficient_law(temperature_pressure_decay, props=5)
