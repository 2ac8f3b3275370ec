# SPDX-License-Identifier: MIT
"""Norton-Hoff friction in arbitrary precision."""

from mpmath import mpf


def value(q, props):
    """The traction that belongs to the slip rate."""
    consistency, exponent, linear = props
    if q.slip_rate == 0:
        return mpf(0)
    length = (q.slip_rate**2 + linear**2) ** mpf("0.5")
    return consistency * length ** (exponent - 1) * q.slip_rate


def _points(*rates, **marks):
    return [{"slip_rate": v, "pressure": 30.0 + k, **marks} for k, v in enumerate(rates)]


_RATES = (1e-20, 3e-4, 1e-3, 0.05, 2.0, 900.0, 1e9)

CASES = [
    {"props": [40.0, 0.15, 1e-3], "points": _points(0.0, *_RATES)},
    {"props": [7.0, 1.0, 0.0], "points": _points(0.0, *_RATES)},
    {"props": [2e-3, 1.5, 0.0], "points": _points(0.0, *_RATES)},
    # without the linear part the slope at rate zero is infinite
    {"props": [3e5, 0.1, 0.0],
     "points": _points(0.0, no_derivative=["slip_rate"]) + _points(*_RATES)},
]  # fmt: skip
