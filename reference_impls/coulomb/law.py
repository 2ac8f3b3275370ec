# SPDX-License-Identifier: MIT
"""Coulomb friction: a constant coefficient, props[0]."""

import usersub


@usersub.coefficient(props=1)
def coulomb(props):
    return props[0]
