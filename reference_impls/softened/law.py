# SPDX-License-Identifier: MIT
"""Coulomb friction whose elastic slip has a given stiffness; props: coefficient, slope of shear
stress over elastic slip. vectors: elastic slip."""

import math

import usersub

#: Smallest normal number: an elastic slip below has no digits and carries nothing.
TINY = 2.2250738585072014e-308


@usersub.traction(props=2, vectors=1)
def softened(motion, pressure, vectors, props):
    strength, slope = props[0] * pressure, props[1]
    x, y = vectors[0, 0] + motion[0], vectors[0, 1] + motion[1]
    length = math.hypot(x, y)
    if slope * length < strength and strength > slope * TINY:
        vectors[0, 0], vectors[0, 1] = x, y
        return slope * x, slope * y
    reach = length if length > 0 else 1.0  # no length: no strength either
    first, second = strength * (x / reach), strength * (y / reach)
    vectors[0, 0], vectors[0, 1] = first / slope, second / slope
    return first, second
