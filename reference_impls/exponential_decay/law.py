# SPDX-License-Identifier: MIT
"""Exponential decay from a static to a kinetic coefficient; props: static, kinetic, decay."""

from usersub.laws.lift import bounded_exp, coefficient_law


def exponential_decay(slip_rate, _pressure, _temperature, props):
    transition = (props[0] - props[1]) * bounded_exp(-props[2] * slip_rate)
    return props[1] + transition, -props[2] * transition, 0.0, 0.0


fric, fric_coef, vfric, vfriction, vfric_coef = coefficient_law(exponential_decay, props=3)
