# SPDX-License-Identifier: MIT
"""Creep without a yield point: slip rate = k traction; props: k."""

from usersub.laws.lift import traction_law


def viscoplastic_creep(slip_rate, _pressure, _temperature, props):
    return slip_rate / props[0], 1.0 / props[0], 0.0, 0.0


fric, vfric, vfriction = traction_law(viscoplastic_creep, props=1)
