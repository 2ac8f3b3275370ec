# SPDX-License-Identifier: MIT
"""Coefficient from a table over slip rate, pressure, temperature and field variables: linear
inside, constant outside; props: see usersub.lift.tables."""

import usersub
from usersub.lift import tables


def needed_props(props):
    return tables.needed_props(props, 1)


@usersub.coefficient(props=needed_props)
def coulomb_tabulated(slip_rate, pressure, temperature, fields, props):
    return tables.value(slip_rate, pressure, temperature, fields, props, 0)
