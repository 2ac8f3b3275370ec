# SPDX-License-Identifier: MIT
"""Tangential damping: shear stress proportional to the slip rate; props: damping coefficient."""

import usersub


@usersub.traction(props=1)
def damping(slip_rate, props):
    return props[0] * slip_rate
