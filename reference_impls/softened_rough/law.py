# SPDX-License-Identifier: MIT
"""No slip: all motion is elastic slip of a given stiffness, whatever the pressure; props: slope of
shear stress over elastic slip. vectors: elastic slip."""

import usersub


@usersub.traction(props=1, vectors=1)
def softened_rough(motion, vectors, props):
    vectors[0, 0] += motion[0]
    vectors[0, 1] += motion[1]
    return props[0] * vectors[0, 0], props[0] * vectors[0, 1]
