# SPDX-License-Identifier: MIT
"""LuGre friction in arbitrary precision: the solution of its equation for a constant velocity."""

from mpmath import exp, mpf, sqrt


def update(q, props):
    """Traction, bristle, no scalar state."""
    mus, muk, vs, delta, sigma0, sigma1, sigma2 = props
    dt = q.time_increment
    v = [x / dt if dt > 0 else mpf(0) for x in q.motion]
    length = sqrt(q.motion[0] ** 2 + q.motion[1] ** 2)
    rate = length / dt if dt > 0 else mpf(0)
    g = q.pressure * (muk + (mus - muk) * exp(-((rate / vs) ** delta)))
    z, z_rate = q.vectors[0], v
    if g <= 0:
        z, z_rate = (mpf(0), mpf(0)), (mpf(0), mpf(0))
    elif length > 0:
        share = exp(-sigma0 * length / g)
        steady = [g / sigma0 * x / length for x in q.motion]
        z = tuple(s + (b - s) * share for s, b in zip(steady, z, strict=True))
        z_rate = [x - sigma0 * rate / g * b for x, b in zip(v, z, strict=True)]
    traction = tuple(
        sigma0 * b + sigma1 * r + sigma2 * x for b, r, x in zip(z, z_rate, v, strict=True)
    )
    return traction, (z,), ()


#: At rest the derivative depends on the direction of the motion that follows.
_REST = {"no_derivative": ["motion 1", "motion 2"]}


def _path(*increments):
    return [
        {"motion": m, "pressure": p, "time_increment": dt} | (_REST if m == (0.0, 0.0) else {})
        for m, p, dt in increments
    ]


CASES = [
    {
        "props": [0.5, 0.3, 0.01, 2.0, 1e3, 2.0, 0.5],
        "path": _path(
            ((1e-4, 0.0), 4.0, 0.25), ((2e-4, -1e-4), 4.0, 2.0**-6), ((3e-3, 1e-3), 4.0, 0.25),
            ((-5e-4, 2e-4), 3.0, 0.125), ((0.0, 0.0), 3.0, 1.0), ((-1e-12, 3e-12), 3.0, 2.0**-8),
            ((0.0, 2e-3), 5.0, 0.25), ((-40.0, 1.0), 5.0, 2.0**-20), ((1e-3, 1e-3), 0.5, 0.5),
            ((1e-4, 0.0), 20.0, 64.0),
        ),
    },
    {  # rising Stribeck curve with a corner at rest; the pressure goes and comes back
        "props": [0.2, 0.6, 0.5, 1.0, 2e4, 0.0, 0.0],
        "path": _path(
            ((1e-4, 2e-4), 30.0, 2.0**-10), ((1e-5, 0.0), 1e-9, 0.25), ((1e-5, 1e-5), 0.0, 0.25),
            ((0.0, 0.0), 0.0, 0.25), ((1e-4, -2e-4), 30.0, 0.25), ((1.0, -2.0), 30.0, 0.25),
        ),
    },
    {"props": [0.4, 0.0, 1e-3, 1.75, 1e8, 10.0, 3.0],
     "path": _path(((1e-7, 0.0), 1e-3, 0.25), ((1e-3, -1e-3), 2.0, 0.25), ((1e-9, 0.0), 5.0, 8.0),
                   ((1e6, 1e6), 5.0, 2.0**40))},
]  # fmt: skip
