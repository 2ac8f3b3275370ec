# SPDX-License-Identifier: MIT
"""Elasto-plastic friction: LuGre with a bristle that is elastic up to its breakaway.

props: mus, muk, vs, delta, sigma0, sigma1, sigma2, breakaway. While the bristle slips in part, its
bend is told by `gap`, what it lacks to its limit, and `angle`, from the motion to the bend; lengths
are in units of the limit.
"""

import math

import usersub
from usersub.lift import real, stribeck

#: Smallest normal number: a bristle of which the limit is below carries nothing.
TINY = 2.2250738585072014e-308

#: Least breakaway: below, the bend where slip begins is lost in rounding.
LEAST = 1e-12

#: Weights that remove the errors of midpoint sums of 2, 4, ... 12 parts up to the order 12.
WEIGHTS = (-1 / 302400, 8 / 945, -2187 / 4480, 65536 / 14175, -9765625 / 798336, 17496 / 1925)


def slack(gap, width):
    """One less alpha times the bend: how much of a motion along the bend bends it further."""
    share = 0.5 * math.pi * gap / width
    return math.sin(share) ** 2 + math.cos(share) ** 2 * gap


def safe_step(gap, angle, width):
    """Motion over which the bend changes little."""
    turn = abs(math.sin(angle))
    fall = 0.5 * math.pi / width * min(1.0, math.pi * abs(gap) / width)
    round_about = (1.0 + 2.0 * math.sqrt(turn)) / (1.0 - gap)
    return 0.5 / (1.0 + fall * abs(math.cos(angle)) + math.sqrt(fall * turn) + round_about)


def approached(gap, angle, motion, width):
    """Gap and angle after a motion: extrapolated midpoint sums.

    A long motion ends in steady slip, exp(-40) away.
    """
    left = motion
    if motion > 40.0:
        gap, angle, left = 0.0 * gap, 0.0 * angle, 0.0 * motion
    while left > 0.0:
        step = min(safe_step(real(gap), real(angle), width), left)
        gap_change, angle_change = 0.0 * gap, 0.0 * gap
        for j in range(6):
            part = step / (2 * j + 2)
            before, angle_before = gap, angle
            here = gap - part * (math.cos(angle) * slack(gap, width))
            angle_here = angle - part * (math.sin(angle) / (1.0 - gap))
            for _ in range(2 * j + 1):
                after = before - 2.0 * part * (math.cos(angle_here) * slack(here, width))
                angle_after = angle_before - 2.0 * part * (math.sin(angle_here) / (1.0 - here))
                before, angle_before = here, angle_here
                here, angle_here = after, angle_after
            gap_change = gap_change + WEIGHTS[j] * (here - gap)
            angle_change = angle_change + WEIGHTS[j] * (angle_here - angle)
        gap, angle, left = gap + gap_change, angle + angle_change, left - step
    return gap, angle


def stuck(along, across, width):
    """Motion that bends the bristle elastically before it slips, and where along it slip begins."""
    breakaway = 1.0 - width
    reach = 0.0 * along
    if abs(across) < breakaway:
        reach = math.sqrt((breakaway - across) * (breakaway + across))
    return max(reach - along, 0.0), max(reach, along)


def slid(along, across, motion, width):
    """Bend after a slip, and its change by further motion, along the motion and across it."""
    gap, angle = 1.0 - math.hypot(along, across), math.atan2(across, along)
    gap, angle = approached(gap, angle, motion, width)
    held = 1.0 - slack(gap, width)
    return (
        (1.0 - gap) * math.cos(angle),
        (1.0 - gap) * math.sin(angle),
        1.0 - held * math.cos(angle) ** 2,
        -held * math.sin(angle) * math.cos(angle),
    )


def held_at_rest(size, width):
    """Alpha times the bend over its square: what the bend keeps of a motion from rest."""
    held = 0.0 * size
    if 1.0 - size <= width:
        held = (1.0 - slack(1.0 - size, width)) / size**2
    return held


@usersub.traction(vectors=1, props=8)
def elasto_plastic(motion, time_increment, pressure, vectors, props):
    stiffness, width = props[4], 1.0 - max(props[7], LEAST)
    per_time = 1.0 / time_increment if time_increment > 0.0 else 0.0
    length = math.hypot(motion[0], motion[1])
    rate = length * per_time
    limit = pressure * stribeck(rate, props[0], props[1], props[2], props[3]) / stiffness
    size = math.hypot(vectors[0, 0], vectors[0, 1])
    first, second = 0.0 * motion[0], 0.0 * motion[1]
    first_rate, second_rate = 0.0 * motion[0], 0.0 * motion[1]
    if real(limit) > TINY:
        first, second = vectors[0, 0] + first, vectors[0, 1] + second
        if size > limit:  # a bend beyond a limit that has fallen goes back to it
            first, second = limit * (first / size), limit * (second / size)
        a_1, a_2 = first / limit, second / limit
        if length > 0.0:
            n_1, n_2 = motion[0] / length, motion[1] / length
            across = a_2 * n_1 - a_1 * n_2
            stick, begin = stuck(a_1 * n_1 + a_2 * n_2, across, width)
            if length / limit < stick:
                first, second = first + motion[0], second + motion[1]
                first_rate, second_rate = per_time * motion[0], per_time * motion[1]
            else:
                along, across, speed, speed_across = slid(
                    begin, across, length / limit - stick, width
                )
                first = limit * (along * n_1 - across * n_2)
                second = limit * (along * n_2 + across * n_1)
                first_rate = rate * (speed * n_1 - speed_across * n_2)
                second_rate = rate * (speed * n_2 + speed_across * n_1)
        else:
            held = held_at_rest(math.hypot(a_1, a_2), width)
            held = held * max(a_1 * motion[0] + a_2 * motion[1], 0.0)
            bent, bent_too = motion[0] - held * a_1, motion[1] - held * a_2
            first, second = first + bent, second + bent_too
            first_rate, second_rate = per_time * bent, per_time * bent_too
    elif length > 0.0:  # zero, but it grows with the pressure
        limit = limit - real(limit)
        first, second = limit * (motion[0] / length), limit * (motion[1] / length)
    vectors[0, 0], vectors[0, 1] = first, second
    viscous = props[6] * per_time
    return (
        stiffness * first + props[5] * first_rate + viscous * motion[0],
        stiffness * second + props[5] * second_rate + viscous * motion[1],
    )
