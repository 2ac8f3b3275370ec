# SPDX-License-Identifier: MIT
"""Interpolation of two tables, variable after variable, in arbitrary precision."""

from itertools import product
from math import prod


def _interval(points, x):
    """Both ends of the interval around x and the shares of their values."""
    x = min(max(x, points[0]), points[-1])
    for i in range(len(points) - 1):
        if x < points[i + 1]:
            share = (x - points[i]) / (points[i + 1] - points[i])
            return (i, 1 - share), (i + 1, share)
    return ((len(points) - 1, 1),)


def value(q, props):
    """Both coefficients: sums over the corners of the cell in which the point lies."""
    nf = int(props[3])
    counts = [int(n) for n in (*props[:3], *props[4 : 4 + nf])]
    starts = [4 + nf + sum(counts[:i]) for i in range(len(counts) + 1)]
    given = (q.slip_rate, q.pressure, q.temperature, *q.fields)
    ends = [_interval(props[s : s + n], x) for s, n, x in zip(starts, counts, given, strict=False)]
    found = []
    for table in (0, 1):
        start = starts[-1] + table * prod(counts)
        found.append(0)
        for corner in product(*ends):
            place = sum(i * prod(counts[:k]) for k, (i, _) in enumerate(corner))
            found[-1] += props[start + place] * prod(share for _, share in corner)
    return tuple(found)


_AXES = [1.0, 50.0, 200.0, 500.0, 2000.0, 60.0, 180.0]
_FIRST = [0.31, 0.27, 0.11, 0.36, 0.24, 0.19, 0.41, 0.33, 0.13, 0.28, 0.22, 0.17]
_SECOND = [0.22, 0.18, 0.07, 0.21, 0.4, 0.11, 0.3, 0.27, 0.05, 0.19, 0.0, 0.16]
_POINTS = [
    {"slip_rate": rate, "pressure": pressure, "temperature": temperature, "fields": [field]}
    for rate, pressure, temperature, field in [
        (0.0, 110.0, 60.0, 0.5), (3.5, 900.0, 115.0, 1.25), (50.0, 500.0, 90.0, -3.0),
        (17.0, 1500.0, 160.0, 2.0), (120.0, 2400.0, 30.0, 1.75), (4e3, 3900.0, 280.0, 8.0),
        (0.0, 0.0, 0.0, 0.0),
    ]
]  # fmt: skip

CASES = [
    {"props": [3, 2, 2, 0, *_AXES, *_FIRST, *_SECOND],
     "points": [{**point, "fields": []} for point in _POINTS]},
    {"props": [1, 1, 1, 0, 0.0, 0.0, 0.0, 0.3, 0.1], "points": _POINTS[:3]},
    {"props": [3, 2, 2, 1, 2, *_AXES, 0.5, 2.0, *_FIRST, *_SECOND, *_SECOND[::-1], *_FIRST[::-1]],
     "points": _POINTS},
]  # fmt: skip
