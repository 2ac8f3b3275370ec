# SPDX-License-Identifier: MIT
"""Iwan friction: parallel elements of spring and slider; props: coefficient, number of elements,
their stiffnesses, their shares of the strength."""

import math

import usersub
from usersub.lift import real

#: An element that a slip left at its limit is rounded: at rest its tangent is that of stick.
ROUNDED = 1.0 + 4.0 * 2.220446049250313e-16

#: Largest number.
HUGE = 1.7976931348623157e308


def elements(props):
    """Number of elements."""
    return int(props[1])


def needed(props):
    """Properties that the elements take; one more than there are, if the number makes no sense."""
    if len(props) < 4:
        return 4
    return 2 + 2 * int(props[1]) if 1 <= props[1] <= len(props) else len(props) + 1


@usersub.traction(vectors=elements, props=needed)
def iwan(motion, pressure, vectors, props):
    n = int(props[1])
    strength = props[0] * pressure
    total_1, total_2 = 0.0 * motion[0], 0.0 * motion[1]
    for i in range(n):
        limit = props[2 + n + i] * strength
        first = vectors[i, 0] + props[2 + i] * motion[0]
        second = vectors[i, 1] + props[2 + i] * motion[1]
        size = math.hypot(first, second)
        far = not size <= HUGE
        if far:  # beyond the largest number: as a length
            first = vectors[i, 0] / props[2 + i] + motion[0]
            second = vectors[i, 1] / props[2 + i] + motion[1]
            size = math.hypot(first, second)
        if far or size >= limit:
            if size > 0.0:
                at_1, at_2 = limit * (first / size), limit * (second / size)
                if far or size > limit * ROUNDED or not limit > 0.0:
                    first, second = at_1, at_2
                else:  # the same value; what changes it is the motion alone
                    first = first + (real(at_1) - real(first))
                    second = second + (real(at_2) - real(second))
            else:
                first, second = 0.0 * first, 0.0 * second
        vectors[i, 0], vectors[i, 1] = first, second
        total_1, total_2 = total_1 + first, total_2 + second
    return total_1, total_2
