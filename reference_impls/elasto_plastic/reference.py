# SPDX-License-Identifier: MIT
"""Elasto-plastic friction in arbitrary precision.

Slip in part by power series of the differential equation. Lengths are in units of the limit; the
gap is what the bend lacks to it, the angle goes from the motion to the bend.
"""

from functools import cache

from mpmath import atan2, cos, exp, hypot, mpf, pi, sin, sqrt, workdps

#: Digits of the solution, which differences need; highest power of a series; bits of its numbers.
_DIGITS, _POWERS, _BITS = 102, 110, 440


def _slack(gap, width):
    """1 - alpha bend, with alpha as it is published."""
    alpha = (1 + sin(pi * ((1 - gap) - (1 - width / 2)) / width)) / 2
    return 1 - alpha * (1 - gap)


def _product(a, b):
    """The last coefficient of a product of series, in whole numbers of 2^-_BITS."""
    return sum(map(int.__mul__, a, reversed(b))) >> _BITS


def _whole(x):
    return int(mpf(x) * 2**_BITS)


def _series(gap, angle, width):
    """Coefficients of gap and angle by powers of the motion."""
    factor, one = _whole(pi / width), 1 << _BITS
    g, psi, slack, over = [_whole(gap)], [_whole(angle)], [], [_whole(1 / (1 - gap))]
    s, c = [_whole(sin(angle))], [_whole(cos(angle))]
    twice = pi / width * gap
    s2, c2 = [_whole(sin(twice))], [_whole(cos(twice))]
    g_slopes, psi_slopes = [], []  # of the derivatives of gap and angle
    for n in range(_POWERS):
        # slack = sin^2 + gap cos^2 of half of pi gap/width
        slack.append(((one if n == 0 else 0) - c2[n] + g[n] + _product(c2, g)) // 2)
        g_slopes.append(-_product(c, slack))
        psi_slopes.append(-_product(s, over))
        s.append(_product(psi_slopes, c) // (n + 1))
        c.append(-_product(psi_slopes, s[:-1]) // (n + 1))
        s2.append((factor * _product(g_slopes, c2) >> _BITS) // (n + 1))
        c2.append(-(factor * _product(g_slopes, s2[:-1]) >> _BITS) // (n + 1))
        g.append(g_slopes[-1] // (n + 1))
        psi.append(psi_slopes[-1] // (n + 1))
        over.append(_product([_product(g[1:], over)], [over[0]]))
    return [[mpf(x) / 2**_BITS for x in coefficients] for coefficients in (g, psi)]


@cache
def _slid(gap, angle, motion, width):
    """Gap and angle after a motion."""
    if motion > 300:  # beyond every digit
        return mpf(0), mpf(0)
    left = motion
    while left > 0:
        series = _series(gap, angle, width)
        last = max(abs(coefficients[-1]) for coefficients in series)
        step = min(
            left, (mpf(10) ** -_DIGITS / max(last, mpf(10) ** -_DIGITS)) ** (mpf(1) / _POWERS)
        )
        gap, angle = (sum(a * step**n for n, a in enumerate(series[i])) for i in (0, 1))
        left -= step
    return gap, angle


def _moved(along, across, motion, breakaway):
    """Bend and its change by further motion, along the motion and across it."""
    width = 1 - breakaway
    reach = sqrt(breakaway**2 - across**2) if abs(across) < breakaway else mpf(0)
    stick = max(reach - along, mpf(0))
    if motion < stick:
        return (along + motion, across), (mpf(1), mpf(0))
    begin = along + stick
    with workdps(_DIGITS):
        gap, angle = 1 - hypot(begin, across), atan2(across, begin)
        gap, angle = _slid(gap, angle, motion - stick, width)
        held = 1 - _slack(gap, width)
        bend = (1 - gap) * cos(angle), (1 - gap) * sin(angle)
        return bend, (1 - held * cos(angle) ** 2, -held * sin(angle) * cos(angle))


def update(q, props):
    """Traction, bristle, no scalar state."""
    mus, muk, vs, delta, sigma0, sigma1, sigma2, breakaway = props
    dt, motion = q.time_increment, q.motion
    v = [x / dt if dt > 0 else mpf(0) for x in motion]
    length = hypot(*motion)
    rate = length / dt if dt > 0 else mpf(0)
    limit = q.pressure * (muk + (mus - muk) * exp(-((rate / vs) ** delta))) / sigma0
    z, z_rate = q.vectors[0], (mpf(0), mpf(0))
    if limit <= 0:
        z = (mpf(0), mpf(0))
    else:
        unit = max(limit, hypot(*z))
        z = [x / unit for x in z]
        if length > 0:
            n1, n2 = (x / length for x in motion)
            bend, speed = _moved(
                z[0] * n1 + z[1] * n2, z[1] * n1 - z[0] * n2, length / limit, breakaway
            )
            z = bend[0] * n1 - bend[1] * n2, bend[0] * n2 + bend[1] * n1
            z_rate = rate * (speed[0] * n1 - speed[1] * n2), rate * (speed[0] * n2 + speed[1] * n1)
        z = tuple(limit * x for x in z)
    traction = tuple(
        sigma0 * b + sigma1 * r + sigma2 * x for b, r, x in zip(z, z_rate, v, strict=True)
    )
    return traction, (z,), ()


#: At rest the derivative depends on the direction of the motion that follows.
_REST = {"no_derivative": ["motion 1", "motion 2", "pressure"]}


def _path(*increments):
    return [
        {"motion": m, "pressure": p, "time_increment": dt} | (_REST if m == (0.0, 0.0) else {})
        for m, p, dt in increments
    ]


CASES = [
    {  # bends turn: limit about 1e-3
        "props": [0.5, 0.4, 0.1, 2.0, 2e3, 2.0, 0.5, 0.7],
        "path": _path(
            ((3e-4, -1e-4), 4.0, 0.25), ((6e-4, 1e-4), 4.0, 2.0**-4), ((1e-4, 3e-4), 4.0, 0.25),
            ((-1e-4, 2e-5), 4.0, 0.125), ((0.0, 0.0), 4.0, 1.0), ((3e-4, -2e-4), 3.0, 2.0**-8),
            ((-1.7e-3, 2e-4), 5.0, 0.25), ((1e-9, 2e-9), 5.0, 0.25), ((2e-5, 4e-5), 0.5, 0.25),
        ),
    },
    {  # one direction, long and short motions; the pressure goes and comes back
        "props": [0.2, 0.6, 0.5, 1.0, 2e4, 0.0, 0.0, 0.5],
        "path": _path(
            ((1e-4, 0.0), 30.0, 0.25), ((2e-4, 0.0), 30.0, 0.25), ((3e-4, 0.0), 30.0, 0.25),
            ((1.0, 0.0), 30.0, 0.25), ((-2e-4, 0.0), 40.0, 0.25), ((-4e-4, 0.0), 20.0, 0.125),
            ((1e-5, 1e-5), 0.0, 0.25), ((0.0, 0.0), 0.0, 0.25), ((1.5e-4, 2e-4), 30.0, 0.25),
            ((-1e6, 0.0), 30.0, 2.0**20),
        ),
    },
    {"props": [0.3, 0.3, 1.0, 1.0, 1e5, 10.0, 0.0, 0.875],
     "path": _path(((2e-5, 0.0), 5.0, 0.25), ((5e-6, 4e-6), 5.0, 0.25))},
]  # fmt: skip
