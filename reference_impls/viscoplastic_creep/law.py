# SPDX-License-Identifier: MIT
"""Creep without a yield point: slip rate = k traction; props: k."""

import usersub


@usersub.traction(props=1)
def viscoplastic_creep(slip_rate, props):
    return slip_rate / props[0]
