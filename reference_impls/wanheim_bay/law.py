# SPDX-License-Identifier: MIT
"""Wanheim-Bay friction, from a coefficient at low pressure to a share of the shear yield stress at
high pressure; props: friction factor, shear yield stress."""

import math

import usersub
from usersub.lift.pairs import add, less, over, pair, sqrt, times, value

ONE, QUARTER_TURN = (1.0, 0.0), (1.5707963267948966, 6.123233995736766e-17)


@usersub.coefficient(props=2)
def wanheim_bay(pressure, props):
    """With q = sqrt(1 - f), A = 1 + pi/2 + acos f + sqrt((1 - f)(1 + f)), mu0 = f/A and x = p/p1,
    where p1 = k A/(1 + q): mu0 up to x = 1, mu0 (1 + q (1 - exp((1 - x)/q)))/x beyond. In pairs,
    since the errors of so many operations add up."""
    f, k = pair(props[0]), pair(props[1])
    q = sqrt(less(ONE, f))
    root = sqrt(times(less(ONE, f), add(ONE, f)))
    angle = add(add(ONE, root), add(QUARTER_TURN, (math.acos(f[0]), 0.0)))
    mu0 = over(f, angle)
    x = over(times(pair(pressure), add(ONE, q)), times(k, angle))
    beyond = value(less(x, ONE))
    if not beyond > 0:
        return value(mu0)
    faded = math.expm1(-beyond / q[0]) if q[0] > 0 else -1.0
    grown = less(ONE, times((q[0], 0.0), pair(faded)))
    return value(over(times(mu0, grown), x))
