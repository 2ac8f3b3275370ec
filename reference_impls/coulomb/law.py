# SPDX-License-Identifier: MIT
"""Coulomb friction: a constant coefficient, props[0]."""

from usersub.laws.lift import coefficient_law


def coulomb(_slip_rate, _pressure, _temperature, props):
    return props[0], 0.0, 0.0, 0.0


fric, fric_coef, vfric, vfriction, vfric_coef = coefficient_law(coulomb, props=1)
