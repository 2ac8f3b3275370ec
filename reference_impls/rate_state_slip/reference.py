# SPDX-License-Identifier: MIT
"""Rate and state friction with the slip law in arbitrary precision."""

from mpmath import exp, log


def value(q, props):
    """The coefficient and theta, from the solution of its differential equation."""
    mu0, a, b, v0, dc, theta0, v_min = props
    theta = q.state[0] or theta0
    steady = dc / max(q.slip_rate, v_min)
    theta = steady * (theta / steady) ** exp(-q.slip_rate * q.time_increment / dc)
    mu = mu0 + a * log(max(q.slip_rate, v_min) / v0) + b * log(v0 * theta / dc)
    return max(mu, 0), (theta,)


def _points(*points):
    """Points by theta at the start, slip rate and time increment."""
    return [
        {"state": [theta], "slip_rate": v, "time_increment": dt, "pressure": 110.0}
        for theta, v, dt in points
    ]


CASES = [
    {
        "props": [0.6, 0.005, 0.01, 1e-6, 1e-5, 10.0, 1e-20],
        "points": _points(
            (0.0, 0.0, 0.25), (0.0, 1e-6, 0.25), (10.0, 1e-5, 1.0), (10.0, 1e-5, 8.0),
            (1e9, 1e-21, 2.0**20), (1e9, 1e-13, 2.0**30), (3.0, 1e3, 2.0**-10), (3.0, 1e10, 1.0),
            (1e-7, 1.0, 2.0**-30), (10.0, 0.0, 0.0), (10.0, 1e-20, 0.25), (2.5, 1e-6, 4.0),
            (2.5, 1e-6, 2.0), (1e3, 0.0, 2.0**50),
        ),
    },
    {
        "props": [0.3, 0.02, 0.003, 1e-3, 0.5, 1e3, 1e-4],
        "points": _points((0.0, 0.0, 0.0), (1e3, 0.7, 1.0), (1e-3, 1e-6, 0.5), (1.0, 1e-4, 2.0)),
    },
    {  # down to no friction
        "props": [0.1, 0.01, 0.03, 1e-6, 1e-5, 10.0, 1e-12],
        "points": _points((0.0, 1e-2, 0.25), (1e-2, 1e3, 0.25), (1e-3, 1e-6, 0.25)),
    },
]  # fmt: skip
