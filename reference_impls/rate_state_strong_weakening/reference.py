# SPDX-License-Identifier: MIT
"""Rate and state friction with strong weakening in arbitrary precision."""

from mpmath import asinh, exp, log, mpf, sinh


def value(q, props):
    """The coefficient and theta, from the solution of the differential equation of psi."""
    f0, a, b, v0, dc, theta0, fw, vw, v_min = props
    theta, rate = q.state[0] or theta0, max(q.slip_rate, v_min)
    low = max(f0 - (b - a) * log(rate / v0), fw)
    steady = fw + (low - fw) / (1 + (q.slip_rate / vw) ** 8) ** (mpf(1) / 8)
    psi_steady = a * log(2 * v0 / rate * sinh(steady / a))
    psi = f0 + b * log(v0 * theta / dc)
    psi = psi_steady + (psi - psi_steady) * exp(-q.slip_rate * q.time_increment / dc)
    mu = a * asinh(q.slip_rate / (2 * v0) * exp(psi / a))
    return mu, (dc / v0 * exp((psi - f0) / b),)


def _points(*points):
    """Points by theta at the start, slip rate and time increment."""
    return [
        {"state": [theta], "slip_rate": v, "time_increment": dt, "pressure": 110.0}
        for theta, v, dt in points
    ]


CASES = [
    {
        "props": [0.6, 0.01, 0.014, 1e-6, 0.4, 4e5, 0.2, 0.1, 1e-20],
        "points": _points(
            (0.0, 0.0, 0.25), (0.0, 1e-6, 0.25), (4e5, 1e-6, 2.0**20), (4e5, 0.09, 0.25),
            (4e5, 0.11, 0.25), (3.0, 1e3, 2.0**-10), (1e-2, 1e6, 1.0), (1e5, 0.0, 0.0),
            (1e3, 5.0, 0.125), (1e9, 1e-12, 2.0**30),
        ),
    },
    {
        "props": [0.3, 0.02, 0.015, 1e-3, 0.5, 1e3, 0.1, 2.0, 1e-6],
        "points": _points((0.0, 0.0, 0.0), (1e3, 0.7, 1.0), (10.0, 2.0, 0.5), (1.0, 1e-5, 2.0)),
    },
]  # fmt: skip
