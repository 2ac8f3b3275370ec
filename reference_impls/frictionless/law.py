# SPDX-License-Identifier: MIT
"""No friction."""

import usersub


@usersub.coefficient(props=0)
def frictionless():
    return 0.0
