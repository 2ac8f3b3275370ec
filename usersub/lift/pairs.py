# SPDX-License-Identifier: MIT
"""Numbers of twice the digits, for laws whose rounding errors would add up.

A pair (high, low) stands for the sum of a double and of a second one below its last place; `pair`
makes one, `value` rounds it. The high part carries the derivatives: each function calculates with
plain numbers and attaches them by its slope.

The counterpart for C is `law/pair.h`, for Fortran `law/pair.fi`.
"""

from __future__ import annotations

import math

from usersub.lift.primitives import real

#: 2^27 + 1, which cuts a double into halves.
_HALVES = 134217729.0


def _near(high, low):
    """high + low; next to an infinity the low part, which is a remainder, is no number."""
    return high, (low if abs(low) < abs(high) else 0.0)


def exact_sum(a, b):
    """a + b of plain numbers, exactly."""
    high = a + b
    part = high - a
    return _near(high, (a - (high - part)) + (b - part))


def exact_product(a, b):
    """a b of plain numbers, exactly."""
    high = a * b
    a_cut, b_cut = _HALVES * a, _HALVES * b
    a_high, b_high = a_cut - (a_cut - a), b_cut - (b_cut - b)
    a_low, b_low = a - a_high, b - b_high
    rest = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low
    return _near(high, rest)


def _add(x, y):
    high, low = exact_sum(x[0], y[0])
    second, third = exact_sum(x[1], y[1])
    high, low = exact_sum(high, low + second)
    return exact_sum(high, low + third)


def _times(x, y):
    high, low = exact_product(x[0], y[0])
    return _near(high, low + (x[0] * y[1] + x[1] * y[0]))


def _over(x, y):
    if y[0] == 0.0:
        return math.copysign(math.inf, x[0]), 0.0
    quotient = x[0] / y[0]
    high, low = exact_product(quotient, y[0])
    return _near(quotient, (((x[0] - high) - low + x[1]) - quotient * y[1]) / y[0])


def _sqrt(x):
    root = math.sqrt(x[0])
    high, low = exact_product(root, root)
    return root, (0.5 * (((x[0] - high) - low) + x[1]) / root if root > 0.0 else 0.0)


def _plain(x):
    return real(x[0]), real(x[1])


def moved(x):
    """Zero with the derivatives of x; without them where x is infinite."""
    return x - real(x) if abs(real(x)) < math.inf else 0.0


def _finite(x):
    """x, or zero where x is infinite: what does not move stays where it is."""
    return x if abs(x) < math.inf else 0.0


def pair(x):
    """The number x, in double precision."""
    return x * 1.0, 0.0


def value(x):
    """The pair, rounded."""
    return x[0] + x[1]


def add(x, y):
    """x + y."""
    high, low = _add(_plain(x), _plain(y))
    return high + (moved(x[0]) + moved(y[0])), low


def less(x, y):
    """x - y."""
    return add(x, (-y[0], -y[1]))


def times(x, y):
    """x y."""
    high, low = _times(_plain(x), _plain(y))
    return high + (moved(x[0]) * _finite(real(y[0])) + _finite(real(x[0])) * moved(y[0])), low


def over(x, y):
    """x / y; an infinity where y is zero."""
    high, low = _over(_plain(x), _plain(y))
    divisor = real(y[0])
    if divisor == 0.0:
        divisor = math.inf
    return high + (moved(x[0]) - moved(y[0]) * _finite(high)) / divisor, low


def sqrt(x):
    """Square root of a pair that is not negative."""
    high, low = _sqrt(_plain(x))
    return high + moved(x[0]) * (0.5 / high if high > 0.0 else 0.0), low
