# SPDX-License-Identifier: MIT
"""Functions that several laws need and that plain formulas spoil by cancellation."""

from __future__ import annotations

import math

from usersub.lift.powers import decay_of_power

#: Smallest normal number: a state that falls below is no state that was never set, which is 0.
_TINY = 2.2250738585072014e-308

#: Largest number.
_HUGE = 1.7976931348623157e308

#: Slip over its distance from which on a state is the steady one in all digits. The formulas of the
#: way there would overflow before their result does.
STEADY = 1e30

#: 2^-64 and its logarithm: what a ratio is smaller by, an exponential is larger by.
_LESS, _MORE = 2.0**-64, 44.3614195558365


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


def log_scaled(factor, above, below):
    """log(factor above/below) of positive numbers, also where the ratio is no number any more."""
    ratio = above / below
    value = factor * ratio
    if _TINY <= ratio <= _HUGE and _TINY <= value <= _HUGE:
        found = math.log(value)
    else:
        found = math.log(factor) + math.log(above) - math.log(below)
    return found


def aged(theta, rate, time_increment, distance):
    """State variable of the ageing law, d theta/dt = 1 - rate theta/distance, after an increment.

    Exact for a constant rate, without cancellation at small and overflow at large slip.
    """
    x = rate * time_increment / distance
    if x > STEADY:
        end = distance / rate
    else:
        end = theta * math.exp(-x) + time_increment * mean_decay(x)
    return max(end, _TINY)


def asinh_product(ratio, exponent):
    """asinh(ratio exp(exponent)) for ratio >= 0, also where exp(exponent) is no number any more."""
    if ratio > math.exp(-max(min(exponent, 700.0), -700.0)):
        size = math.log(ratio) + exponent
        value = size + math.log1p(math.sqrt(1.0 + math.exp(-2.0 * size)))
    else:
        value = math.asinh(ratio * math.exp(min(exponent, 600.0)))
    return value


def asinh_rate(rate, reference, exponent):
    """asinh(rate/reference exp(exponent)) for rate >= 0 and reference > 0.

    Also where rate/reference is too large for a number.
    """
    ratio = rate / reference
    if not ratio < _HUGE:
        ratio, exponent = _LESS * rate / reference, exponent + _MORE
    return asinh_product(ratio, exponent)


def stribeck(rate, static, kinetic, velocity, exponent):
    """Coefficient of steady sliding of a Stribeck curve without viscous part.

    kinetic + (static - kinetic) exp(-(rate/velocity)^exponent)
    """
    return kinetic + (static - kinetic) * decay_of_power(rate, 0.0, velocity, exponent)
