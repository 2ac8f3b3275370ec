# SPDX-License-Identifier: MIT
"""Rate and state friction, regularised, with the ageing law in arbitrary precision."""

from mpmath import asinh, exp, log


def value(q, props):
    """The coefficient and theta, from the solution of its differential equation."""
    f0, a, b, v0, dc, theta0 = props
    theta = q.state[0] or theta0
    if q.slip_rate == 0:
        theta += q.time_increment
    else:
        steady = dc / q.slip_rate
        theta = steady + (theta - steady) * exp(-q.slip_rate * q.time_increment / dc)
    exponent = (f0 + b * log(v0 * theta / dc)) / a
    return a * asinh(q.slip_rate / (2 * v0) * exp(exponent)), (theta,)


def _points(*points):
    """Points by theta at the start, slip rate and time increment."""
    return [
        {"state": [theta], "slip_rate": v, "time_increment": dt, "pressure": 110.0} | _mark(v, dt)
        for theta, v, dt in points
    ]


def _mark(rate, dt):
    """After a long rest the derivative at zero rate holds up to rates below any difference."""
    return {"no_derivative": ["slip_rate"]} if rate == 0 and dt > 1 else {}


CASES = [
    {
        "props": [0.6, 0.01, 0.014, 1e-6, 1e-5, 10.0],
        "points": _points(
            (0.0, 0.0, 0.25), (0.0, 1e-6, 0.25), (10.0, 1e-5, 1.0), (10.0, 1e-5, 8.0),
            (1e9, 1e-13, 2.0**30), (3.0, 1e3, 2.0**-10), (3.0, 1e10, 1.0), (10.0, 0.0, 0.0),
            (2.5, 1e-6, 2.0), (1e3, 0.0, 2.0**50),
        ),
    },
    {
        "props": [0.3, 0.02, 0.003, 1e-3, 0.5, 1e3],
        "points": _points((0.0, 0.0, 0.0), (1e3, 0.7, 1.0), (1e-3, 1e-6, 0.5), (1.0, 1e-5, 2.0)),
    },
    {  # exp(f0/a) is no number any more
        "props": [0.75, 0.001, 0.004, 1e-6, 1e-5, 10.0],
        "points": _points((0.0, 1e-6, 0.25), (1.0, 1e-3, 0.25), (1e6, 1e-9, 1.0)),
    },
]  # fmt: skip
