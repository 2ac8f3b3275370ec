# SPDX-License-Identifier: MIT
"""Coulomb friction up to a largest shear stress; props: coefficient, largest shear stress."""

import usersub


@usersub.coefficient(props=2)
def shear_limit(pressure, props):
    mu, limit = props[0], props[1]
    if pressure > 0 and mu >= limit / pressure:
        return limit / pressure
    return mu
