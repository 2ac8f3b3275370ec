# SPDX-License-Identifier: MIT
"""Temperature softening in arbitrary precision."""

from mpmath import exp, mpf


def value(q, props):
    """The coefficient."""
    form, cold, hot, start, end, exponent = props
    warmth = max((q.temperature - start) / (end - start), mpf(0))
    power = warmth**exponent
    if form == 2:
        return hot + (cold - hot) * exp(-power)
    return hot + (cold - hot) * (1 - min(power, mpf(1)))


def _points(*temperatures, **marks):
    return [{"temperature": t, "pressure": 30.0 * k, **marks} for k, t in enumerate(temperatures)]


_TEMPERATURES = (-60.0, 0.0, 20.5, 150.0, 600.0, 1399.0, 1400.0, 9e3)

CASES = [
    {"props": [1, 0.4, 0.0, 20.0, 1400.0, 1.0], "points": _points(20.0, *_TEMPERATURES)},
    {"props": [1, 0.35, 0.08, 20.0, 1400.0, 2.3], "points": _points(20.0, *_TEMPERATURES)},
    {"props": [2, 0.3, 0.1, 20.0, 400.0, 1.0], "points": _points(20.0, *_TEMPERATURES)},
    # below one the slope at the first temperature is infinite
    {"props": [1, 0.25, 0.05, 20.0, 1400.0, 0.6],
     "points": _points(*_TEMPERATURES) + _points(20.0, no_derivative=["temperature"])},
    {"props": [2, 0.25, 0.0, 20.0, 300.0, 0.8],
     "points": _points(*_TEMPERATURES) + _points(20.0, no_derivative=["temperature"])},
]  # fmt: skip
