# SPDX-License-Identifier: MIT
"""Two coefficients from tables over slip rate, pressure, temperature and field variables: linear
inside, constant outside; props: see usersub.lift.tables."""

import usersub
from usersub.lift import tables


def needed_props(props):
    return tables.needed_props(props, 2)


@usersub.coefficient(props=needed_props)
def anisotropic_tabulated(slip_rate, pressure, temperature, fields, props):
    first = tables.value(slip_rate, pressure, temperature, fields, props, 0)
    second = tables.value(slip_rate, pressure, temperature, fields, props, 1)
    return first, second
