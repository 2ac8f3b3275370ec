# SPDX-License-Identifier: MIT
"""exp, log and pow as straight code that a compiler can put into a vector loop.

No branch, no table and no operation whose bits depend on its neighbours or on the processor: every
lane, every block size and every machine give the same bits. Polynomials interpolate in Chebyshev
points, fitted with fifty digits; products that need them keep their rounding errors (fma).

Errors, against fifty digits, in units of the last place of the exact result: exp 0.9, log 0.9,
pow 0.6; where the result is denormal 1.0. Special values are those of C (Annex F).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from usersub.routine.lanes import Lanes, Value, bits_of

_INVERSE_LN2 = float.fromhex("0x1.71547652b82fep+0")
#: ln 2 in parts: the first ends in zeros, so that multiples by exponents are exact.
_LN2 = tuple(
    map(float.fromhex, ("0x1.62e42fee00000p-1", "0x1.a39ef35793c76p-33", "0x1.cc01f97b57a08p-87"))
)
#: Adding it leaves a whole number in the last digits.
_WHOLE = 1.5 * 2.0**52
_BIAS = 1023
_SIGN = -(2**63)
_LEAST_NORMAL = 2.0**-1022
#: Numbers are cut into 2^k m with m from here to twice this.
_ROOT_HALF = bits_of(math.sqrt(0.5))

#: (e^r - 1 - r)/r^2 for |r| up to half of ln 2, relative to e^r to 2^-61.
_EXP = tuple(
    map(
        float.fromhex,
        (
            "0x1.0000000000000p-1", "0x1.5555555555557p-3", "0x1.5555555555556p-5",
            "0x1.11111111100dcp-7", "0x1.6c16c16c162d4p-10", "0x1.a01a01abe7fe1p-13",
            "0x1.a01a01a6d889cp-16", "0x1.71de0231960ebp-19", "0x1.27e4db646b17ep-22",
            "0x1.af4de97ca4194p-26", "0x1.1f730349868cep-29",
        ),
    )
)  # fmt: skip
#: (ln((1 + s)/(1 - s)) - 2 s)/s^3 by s^2, relative to the logarithm to 2^-60.
_LOG = tuple(
    map(
        float.fromhex,
        (
            "0x1.5555555555555p-1", "0x1.9999999999a38p-2", "0x1.2492492476c87p-2",
            "0x1.c71c720160b47p-3", "0x1.745cf901605f7p-3", "0x1.3b1c360763b8ap-3",
            "0x1.0fbe83c2cbcf3p-3", "0x1.0c04595972ab8p-3",
        ),
    )
)  # fmt: skip
#: The same without its first term 2/3, divided by s^2, to 2^-66.
_LOG_LONG = tuple(
    map(
        float.fromhex,
        (
            "0x1.999999999999ap-2", "0x1.2492492492521p-2", "0x1.c71c71c6eaa10p-3",
            "0x1.745d177a96056p-3", "0x1.3b1395d2190c1p-3", "0x1.1118c7e4b0917p-3",
            "0x1.df7cc8e5fa539p-4", "0x1.e02e6fff27908p-4",
        ),
    )
)  # fmt: skip
_TWO_THIRDS = (float.fromhex("0x1.5555555555555p-1"), float.fromhex("0x1.5555555555555p-55"))


def _polynomial(code: Lanes, x: Value, coefficients: Sequence[float]) -> Value:
    """The polynomial, by pairs, pairs of pairs and so on: short chains for a lone number."""
    terms: list[Value | float] = list(coefficients)
    while len(terms) > 1:
        paired: list[Value | float] = []
        for i in range(0, len(terms) - 1, 2):
            paired.append(code.fma(x, terms[i + 1], terms[i]))
        if len(terms) % 2:
            paired.append(terms[-1])
        terms = paired
        x = x * x if len(terms) > 1 else x
    (result,) = terms
    assert isinstance(result, Value)
    return result


def _power_of_two(k: Value) -> Value:
    """2^k for a whole k in reach of normal numbers."""
    return ((k + (_WHOLE + _BIAS)).bits() << 52).real()


def _exp_of_parts(code: Lanes, x: Value, low: Value | None) -> Value:
    """e^(x + low) for x between -746 and 710, or NaN."""
    k = code.fma(x, _INVERSE_LN2, _WHOLE) - _WHOLE
    r = code.fma(k, -_LN2[0], x)
    rest = k * -_LN2[1]
    if low is not None:
        rest = rest + low
    r, start = r + rest, r
    lost = (start - r) + rest
    q = _polynomial(code, r, _EXP)
    value = code.fma(r * r, q, lost) + r + 1.0
    # Two steps, since 2^k itself may be beyond the normal numbers.
    half = code.fma(k, 0.5, _WHOLE) - _WHOLE
    return value * _power_of_two(half) * _power_of_two(k - half)


def _clamped(x: Value) -> Value:
    """x within what `_exp_of_parts` takes; beyond it results are zero or infinite anyway."""
    x = (x < -746.0).otherwise(-746.0, x)
    return (x > 710.0).otherwise(710.0, x)


def exp(code: Lanes, x: Value) -> Value:
    """e^x."""
    return _exp_of_parts(code, _clamped(x), None)


def _cut(x: Value) -> tuple[Value, Value]:
    """k and m of a positive number 2^k m, m between the root of 1/2 and of 2."""
    tiny = x < _LEAST_NORMAL
    bits = tiny.otherwise(x * 2.0**54, x).bits()
    offset = 1024 << 52
    shifted = bits + (offset - _ROOT_HALF)
    m = (bits - (shifted & -(1 << 52)) + offset).real()
    # A whole number below 2^52 in the last digits of a double.
    k = ((shifted >> 52) | bits_of(2.0**52)).real()
    return k - tiny.otherwise(2.0**52 + 1024 + 54, 2.0**52 + 1024), m


def log(code: Lanes, x: Value) -> Value:
    """Natural logarithm: -inf of zero, NaN of what is below."""
    k, m = _cut(x)
    f = m - 1.0
    s = f / (m + 1.0)
    z = s * s
    half_square = f * (f * 0.5)
    tail = code.fma(s, half_square + z * _polynomial(code, z, _LOG), k * _LN2[1])
    value = code.fma(k, _LN2[0], f - (half_square - tail))
    value = x.same(math.inf).otherwise(math.inf, value)
    value = x.same(0.0).otherwise(-math.inf, value)
    return ((x < 0.0) | x.is_nan()).otherwise(math.nan, value)


def _long_log(code: Lanes, x: Value) -> tuple[Value, Value]:
    """Natural logarithm of a positive number in two parts, to 2^-65 of it."""
    k, m = _cut(x)
    f, g = m - 1.0, m + 1.0
    g_low = m - (g - 1.0)
    inverse = code.constant(1.0) / g
    s = f * inverse
    s_low = (code.fma(s * -1.0, g, f) - s * g_low) * inverse
    z = s * s
    z_low = code.fma(s, s, z * -1.0) + s * s_low * 2.0
    # 2 s + (2/3 + z q(z)) s^3
    q = z * _polynomial(code, z, _LOG_LONG)
    c = q + _TWO_THIRDS[0]
    c_low = (q - (c - _TWO_THIRDS[0])) + _TWO_THIRDS[1]
    cube = z * s
    cube_low = code.fma(z, s, cube * -1.0) + (z * s_low + z_low * s)
    term = c * cube
    term_low = code.fma(c, cube, term * -1.0) + (c * cube_low + c_low * cube)
    high = s * 2.0
    value = high + term
    low = ((high - value) + term) + (term_low + s_low * 2.0)
    # ... + k ln 2, whose first part is exact and longer than the rest
    whole = k * _LN2[0]
    total = whole + value
    low = ((whole - total) + value) + (low + k * _LN2[1])
    return total, low


def power(code: Lanes, x: Value, y: Value) -> Value:
    """x^y."""
    size = code.call("fabs", x)
    log_high, log_low = _long_log(code, size)
    log_high = size.same(math.inf).otherwise(math.inf, log_high)
    log_high = size.same(0.0).otherwise(-math.inf, log_high)
    high = y * log_high
    low = code.fma(y, log_high, high * -1.0) + y * log_low
    inside = code.call("fabs", high) < 800.0
    value = _exp_of_parts(code, _clamped(high), inside.otherwise(low, 0.0))

    whole = code.call("trunc", y).same(y)
    half = y * 0.5
    odd = whole & code.call("trunc", half).differs(half)
    negative = code.call("copysign", code.constant(1.0), x) < 0.0
    value = (negative & odd).otherwise(value * -1.0, value)
    no_root = (x < 0.0) & code.call("trunc", y).differs(y) & (size < math.inf)
    value = (no_root | x.is_nan() | y.is_nan()).otherwise(math.nan, value)
    one = x.same(1.0) | y.same(0.0)
    one = one | (x.same(-1.0) & code.call("fabs", y).same(math.inf))
    return one.otherwise(1.0, value)


#: Names in LLVM's intrinsics, number of arguments, code.
FUNCTIONS = {"exp": (1, exp), "log": (1, log), "pow": (2, power)}
