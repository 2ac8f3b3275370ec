# SPDX-License-Identifier: MIT
"""Generalised Maxwell slip: elements that stick as springs and, slipping, are attracted by a
Stribeck curve; props: mus, muk, vs, delta, attraction, viscosity, number of elements, their
stiffnesses, their shares of the strength."""

import math

import usersub
from usersub.lift import stribeck


def elements(props):
    """Number of elements."""
    return int(props[6])


def needed(props):
    """Properties that the elements take; one more than there are, if the number makes no sense."""
    if len(props) < 9:
        return 9
    return 7 + 2 * int(props[6]) if 1 <= props[6] <= len(props) else len(props) + 1


def decay(attraction, time, strength):
    """How much of the distance to the Stribeck curve is left."""
    if strength > 0.0:
        left = math.exp(-min(attraction * time / strength, 1e30))
    else:
        left = 0.0 * strength
    return left


def at_rest(vectors, i, left, limit):
    """An element above its limit, where nothing moves: it relaxes along its traction."""
    size = math.hypot(vectors[i, 0], vectors[i, 1])
    if size > limit:
        share = (limit + (size - limit) * left) / size
        vectors[i, 0], vectors[i, 1] = share * vectors[i, 0], share * vectors[i, 1]


@usersub.traction(vectors=elements, states=elements, props=needed)
def maxwell_slip(motion, time_increment, pressure, vectors, state, props):
    n = int(props[6])
    per_time = 1.0 / time_increment if time_increment > 0.0 else 0.0
    length = math.hypot(motion[0], motion[1])
    if not length > 0.0:  # all elements stick: the strength at rest does not depend on the motion
        length = 0.0 * motion[0]
    strength = pressure * stribeck(length * per_time, props[0], props[1], props[2], props[3])
    total_1, total_2 = props[5] * per_time * motion[0], props[5] * per_time * motion[1]
    for i in range(n):
        stiffness, limit = props[7 + i], props[7 + n + i] * strength
        if length > 0.0:
            n_1, n_2 = motion[0] / length, motion[1] / length
            along = vectors[i, 0] * n_1 + vectors[i, 1] * n_2
            across = vectors[i, 1] * n_1 - vectors[i, 0] * n_2
            # Slip begins where the traction along the motion is `begin`, after the motion `stick`.
            begin, stick = along, 0.0 * along
            if not (state[i] > 0.0 and along > 0.0):
                reach = 0.0 * along
                if abs(across) < limit:
                    reach = math.sqrt(limit - across) * math.sqrt(limit + across)
                if along < reach:
                    begin, stick = reach, (reach - along) / stiffness
            if length < stick:
                vectors[i, 0] = vectors[i, 0] + stiffness * motion[0]
                vectors[i, 1] = vectors[i, 1] + stiffness * motion[1]
                state[i] = 0.0
            else:
                left = decay(props[4], time_increment * (1.0 - stick / length), strength)
                along, across = limit + (begin - limit) * left, across * left
                vectors[i, 0] = along * n_1 - across * n_2
                vectors[i, 1] = along * n_2 + across * n_1
                state[i] = 1.0
        else:
            at_rest(vectors, i, decay(props[4], time_increment, strength), limit)
            vectors[i, 0] = vectors[i, 0] + stiffness * motion[0]
            vectors[i, 1] = vectors[i, 1] + stiffness * motion[1]
            state[i] = 0.0
        total_1, total_2 = total_1 + vectors[i, 0], total_2 + vectors[i, 1]
    return total_1, total_2
