# SPDX-License-Identifier: MIT
"""Interpolation variable after variable, in arbitrary precision."""


def _over(points, values, x):
    """Over the last variable; what is left are the values of a smaller table."""
    part = len(values) // len(points)
    rows = [values[i * part : (i + 1) * part] for i in range(len(points))]
    x = min(max(x, points[0]), points[-1])
    for i in range(len(points) - 1):
        if x < points[i + 1]:
            share = (x - points[i]) / (points[i + 1] - points[i])
            return [a * (1 - share) + b * share for a, b in zip(rows[i], rows[i + 1], strict=True)]
    return rows[-1]


def value(q, props):
    """The coefficient."""
    rest = list(props)
    counts = [int(rest.pop(0)) for _ in range(4)]
    counts[3:] = [int(rest.pop(0)) for _ in range(counts[3])]
    axes = [[rest.pop(0) for _ in range(n)] for n in counts]
    given = (q.slip_rate, q.pressure, q.temperature, *q.fields)
    for points, x in reversed(list(zip(axes, given, strict=True))):
        rest = _over(points, rest, x)
    return rest[0]


_AXES = [1.0, 50.0, 200.0, 500.0, 2000.0, 60.0, 180.0]
_VALUES = [0.31, 0.27, 0.11, 0.36, 0.24, 0.19, 0.41, 0.33, 0.13, 0.28, 0.22, 0.17]
_POINTS = [
    {"slip_rate": rate, "pressure": pressure, "temperature": temperature}
    for rate, pressure, temperature in [
        (0.0, 110.0, 60.0), (3.5, 900.0, 115.0), (50.0, 500.0, 90.0), (17.0, 1500.0, 160.0),
        (120.0, 2400.0, 30.0), (4000.0, 3900.0, 280.0), (200.0, 2000.0, 180.0), (0.0, 0.0, 0.0),
    ]
]  # fmt: skip
_FIELDS = [(0.5, -3.0), (1.25, 40.0), (-1.0, 2.0), (2.0, 7.0), (1.0, 11.0), (9.0, 90.0),
           (0.25, 7.0), (1.9, -1.0)]  # fmt: skip

CASES = [
    {"props": [3, 2, 2, 0, *_AXES, *_VALUES], "points": _POINTS},
    {"props": [1, 1, 1, 0, 7.0, 8.0, 9.0, 0.15], "points": _POINTS},
    {"props": [2, 1, 1, 0, 0.0, 200.0, 0.0, 0.0, 0.15, 0.05], "points": _POINTS},
    # two field variables with two and three points; some coefficients are next to nothing
    {"props": [3, 2, 2, 2, 2, 3, *_AXES, 0.5, 2.0, -1.0, 7.0, 30.0,
               *(v * s for s in (1.0, 1e-9, 0.3, 1.7, 0.9, 0.0) for v in _VALUES)],
     "points": [{**p, "fields": f} for p, f in zip(_POINTS, _FIELDS, strict=True)]},
]  # fmt: skip
