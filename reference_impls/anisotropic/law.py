# SPDX-License-Identifier: MIT
"""A constant coefficient in each of both local directions; props: the two."""

import usersub


@usersub.coefficient(props=2)
def anisotropic(props):
    return props[0], props[1]
