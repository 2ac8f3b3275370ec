# SPDX-License-Identifier: MIT
"""Stribeck curve in arbitrary precision."""

from mpmath import exp


def value(q, props):
    """The coefficient."""
    mus, muk, rate, exponent, viscous = props
    return muk + (mus - muk) * exp(-((q.slip_rate / rate) ** exponent)) + viscous * q.slip_rate


def _points(*rates, **marks):
    return [{"slip_rate": v, "pressure": 110.0 + 3.0 * min(v, 1e3), **marks} for v in rates]


_RATES = (1e-20, 1e-9, 2e-3, 0.01, 0.07, 3.5, 1e4)

CASES = [
    {"props": [0.3, 0.1, 0.01, 2.0, 5e-4], "points": _points(0.0, *_RATES)},
    {"props": [0.25, 0.05, 0.3, 1.0, 0.0], "points": _points(0.0, *_RATES, 1e30)},
    # below one the slope at rate zero is infinite
    {"props": [0.2, 0.12, 0.02, 0.5, 1e-3],
     "points": _points(0.0, no_derivative=["slip_rate"]) + _points(*_RATES)},
    # nothing but the tail of the exponential
    {"props": [0.4, 0.0, 0.01, 1.3, 0.0], "points": _points(0.01, 0.03, 0.06, 0.1)},
]  # fmt: skip
