# SPDX-License-Identifier: MIT
"""Functions that several laws need and that plain formulas spoil by cancellation."""

from __future__ import annotations

import math

from usersub.lift.powers import decay_of_power

#: Smallest normal number: a state that falls below is no state that was never set, which is 0.
_TINY = 2.2250738585072014e-308


#: exp(x) is a normal number down to here; below nothing is left that a coefficient could show.
_EXP_BOUND = -700.0


def bounded_exp(x):
    """exp(x) for x <= 0, without the slow numbers below the normal ones."""
    return math.exp(max(x, _EXP_BOUND))


def mean_decay(x):
    """Mean of exp(-t) for t from 0 to x, (1 - exp(-x))/x, for x >= 0.

    A series below the corner: there the plain formula loses digits of its derivative, and all of
    them at zero.
    """
    if x < 0.25:
        mean = 1.0 - x / 12.0
        for n in range(11, 1, -1):
            mean = 1.0 - x * mean / n
    else:
        mean = -math.expm1(-x) / x
    return mean


def aged(theta, rate, time_increment, distance):
    """State variable of the ageing law, d theta/dt = 1 - rate theta/distance, after an increment.

    Exact for a constant rate, without cancellation at small and overflow at large slip.
    """
    x = rate * time_increment / distance
    return max(theta * math.exp(-x) + time_increment * mean_decay(x), _TINY)


def asinh_product(ratio, exponent):
    """asinh(ratio exp(exponent)) for ratio >= 0, also where exp(exponent) is no number any more."""
    if ratio > math.exp(-max(min(exponent, 700.0), -700.0)):
        size = math.log(ratio) + exponent
        value = size + math.log1p(math.sqrt(1.0 + math.exp(-2.0 * size)))
    else:
        value = math.asinh(ratio * math.exp(min(exponent, 600.0)))
    return value


def stribeck(rate, static, kinetic, velocity, exponent):
    """Coefficient of steady sliding of a Stribeck curve without viscous part.

    kinetic + (static - kinetic) exp(-(rate/velocity)^exponent)
    """
    return kinetic + (static - kinetic) * decay_of_power(rate, 0.0, velocity, exponent)
