# SPDX-License-Identifier: MIT
"""A share of the shear yield stress, whatever the pressure; props: friction factor, shear yield
stress."""

import usersub


@usersub.strength(props=2)
def tresca(props):
    return props[0] * props[1]
