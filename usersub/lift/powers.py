# SPDX-License-Identifier: MIT
"""Powers inside exponentials and products.

Each digit of a power that is lost is lost to its exponential as often as the power is large, and
each factor of a product adds its errors: here logarithms have some ten bits more than a double, and
the results are exact to about a unit in the last place. Exponents are constants: derivatives go by
the other arguments.

The counterpart for C is `law/powers.h`, for Fortran `law/powers.fi`.
"""

from __future__ import annotations

import math

from usersub.lift.pairs import exact_product, exact_sum, less, moved, over, pair
from usersub.lift.primitives import real

_ROOT_OF_HALF = 0.7071067811865476
#: log 2; the high part has so few digits that a whole number times it is exact.
_LOG_2_HIGH, _LOG_2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
#: exp overflows beyond.
_LARGEST_EXPONENT = 709.782712893384
#: Stands for the logarithm of zero: its exponential is zero.
_LOG_0 = -1e30


def _log(x):
    """Logarithm of a pair: with x = 2^e m and s = (m - 1)/(m + 1) it is e log 2 + 2 artanh s."""
    if not x[0] > 0.0:
        return _LOG_0, 0.0
    m, e = math.frexp(x[0])
    if m < _ROOT_OF_HALF:
        m, e = 2.0 * m, e - 1
    top, bottom = m - 1.0, m + 1.0
    lost, inverse = m - (bottom - 1.0), 1.0 / bottom
    s = top * inverse
    high, low = exact_product(s, bottom)
    t = s * s
    series = 0.0
    for k in range(23, 1, -2):
        series = series * t + 2.0 / k
    rest = 2.0 * (((top - high) - low) - s * lost) * inverse + s * t * series
    high, low = exact_sum(e * _LOG_2_HIGH, 2.0 * s)
    return exact_sum(high, low + (rest + x[1] / x[0] + e * _LOG_2_LOW))


def _log_of_power(x, exponent):
    """exponent log(x), 0 where the exponent is 0, of plain numbers."""
    if exponent == 0.0:
        return 0.0, 0.0
    logarithm = _log(x)
    high, low = exact_product(exponent, logarithm[0])
    return high, low + exponent * logarithm[1]


def _exp(x):
    """Exponential, by one step of Newton's method from that of the high part."""
    if x[0] > _LARGEST_EXPONENT:
        return math.inf, 0.0
    first = math.exp(x[0])
    if first < 2.2250738585072014e-308:
        return first, 0.0
    logarithm = _log((first, 0.0))
    return first, first * ((x[0] - logarithm[0]) + (x[1] - logarithm[1]))


def _share(x, start, end):
    """(x - start)/(end - start), plain; how it moves, relative to itself."""
    distance = less(pair(x), pair(start))
    share = over(distance, less(pair(end), pair(start)))
    return (real(share[0]), real(share[1])), moved(share[0]) / real(share[0])


def decay_of_power(x, start, end, exponent):
    """exp(-((x - start)/(end - start))**exponent), 1 before start.

    Its derivative at start is the one from above, or 0 where that is infinite (exponent below 1).
    """
    if x < start or (x == start and (exponent != 1.0 or not end > start)):
        return 1.0
    if x == start:
        return 1.0 - moved(x) / (end - start)
    if not end > start:  # a step
        return 0.0
    share, change = _share(x, start, end)
    power, rest = _exp(_log_of_power(share, real(exponent)))
    if power > 750.0:
        return 0.0
    decay = math.exp(-power)
    return (decay - decay * rest) - decay * (power * real(exponent)) * change


def drop_of_power(x, start, end, exponent):
    """1 - ((x - start)/(end - start))**exponent, 1 before start, 0 from end on.

    Derivatives as those of `decay_of_power`.
    """
    if x < start or (x == start and (exponent != 1.0 or not end > start)):
        return 1.0
    if x == start:
        return 1.0 - moved(x) / (end - start)
    if x >= end:
        return 0.0
    share, change = _share(x, start, end)
    power, rest = _log_of_power(share, real(exponent))
    fallen = math.expm1(power)
    return (-fallen - rest * (1.0 + fallen)) - math.exp(power) * real(exponent) * change


def product_of_powers(factor, x, a, y=1.0, b=0.0, z=1.0, c=0.0):
    """factor x**a y**b z**c of numbers that are not negative.

    As it is one exponential of a sum, no part of it overflows before the product does.
    """
    logarithm = _sum(_of_power(factor, 1.0), _of_power(x, a))
    high, low = _sum(_sum(logarithm, _of_power(y, b)), _of_power(z, c))
    if high > _LARGEST_EXPONENT:
        return math.inf
    product = math.exp(high)
    change = (_change(factor, 1.0) + _change(x, a)) + (_change(y, b) + _change(z, c))
    return (product + product * low) + product * change


def _of_power(x, exponent):
    return _log_of_power((real(x) * 1.0, 0.0), real(exponent))


def _sum(x, y):
    high, low = exact_sum(x[0], y[0])
    return high, low + (x[1] + y[1])


def _change(x, exponent):
    """How x**exponent moves, relative to itself."""
    size = real(x)
    return real(exponent) * moved(x) / (size if size > 0.0 else math.inf)
