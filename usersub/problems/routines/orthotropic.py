# SPDX-License-Identifier: MIT
"""Friction along the slip, direction by direction with its own coefficient; props: both
coefficients, allowable elastic slip. vectors: elastic slip."""

import math

import usersub


@usersub.traction(props=3, vectors=1)
def orthotropic(motion, pressure, vectors, props):
    x, y = vectors[0, 0] + motion[0], vectors[0, 1] + motion[1]
    length = math.hypot(x, y)
    if length < props[2]:
        vectors[0, 0], vectors[0, 1] = x, y
        reach = props[2]
    else:
        vectors[0, 0], vectors[0, 1] = props[2] * (x / length), props[2] * (y / length)
        reach = length
    return props[0] * pressure * (x / reach), props[1] * pressure * (y / reach)
