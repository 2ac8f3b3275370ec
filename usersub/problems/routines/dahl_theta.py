# SPDX-License-Identifier: MIT
"""Dahl's bristle, integrated over the increment by the theta rule; props: coefficient, stiffness,
theta (0 explicit Euler, 1/2 trapezoidal rule, 1 implicit Euler)."""

import math

import usersub


@usersub.traction(vectors=1, props=3)
def dahl_theta(motion, pressure, vectors, props):
    stiffness, theta = props[1], props[2]
    limit = props[0] * pressure / stiffness
    first, second = vectors[0, 0], vectors[0, 1]
    if limit > 0.0:
        share = math.hypot(motion[0], motion[1]) / limit
        left, under = 1.0 - (1.0 - theta) * share, 1.0 + theta * share
        first = (left * first + motion[0]) / under
        second = (left * second + motion[1]) / under
    else:
        first, second = 0.0 * motion[0], 0.0 * motion[1]
    vectors[0, 0], vectors[0, 1] = first, second
    return stiffness * first, stiffness * second
