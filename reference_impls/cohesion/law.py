# SPDX-License-Identifier: MIT
"""Coulomb friction with cohesion; props: cohesion, coefficient."""

import usersub


@usersub.strength(props=2)
def cohesion(pressure, props):
    return props[0] + props[1] * pressure
