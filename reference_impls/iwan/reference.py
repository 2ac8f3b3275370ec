# SPDX-License-Identifier: MIT
"""Iwan friction in arbitrary precision: radial return of every element, as complex numbers."""

from mpmath import mpc, mpf


def update(q, props):
    """Traction, tractions of the elements, no scalar state."""
    n = int(props[1])
    motion, ends = mpc(*q.motion), []
    for stiffness, share, start in zip(props[2 : n + 2], props[n + 2 :], q.vectors, strict=True):
        end = mpc(*start) + stiffness * motion
        limit = share * props[0] * q.pressure
        if abs(end) > limit:
            end *= limit / abs(end)
        ends.append(end)
    total = sum(ends, mpc(0))
    return (total.real, total.imag), tuple((mpf(e.real), mpf(e.imag)) for e in ends), ()


#: Where an element stands at its limit the derivative depends on the motion that follows.
_CORNER = {"no_derivative": ["motion 1", "motion 2", "pressure"]}


def _path(*increments):
    return [
        {"motion": m, "pressure": p} | (_CORNER if m == (0.0, 0.0) else {}) for m, p in increments
    ]


CASES = [
    {
        "props": [0.5, 3, 4e3, 2e3, 1e3, 0.2, 0.3, 0.5],
        "path": _path(
            ((5e-5, 0.0), 4.0), ((1e-4, -3e-5), 4.0), ((4e-4, 1e-4), 4.0), ((0.0, 0.0), 4.0),
            ((-1.5e-4, 1e-5), 4.0), ((2e-3, 3e-4), 3.0), ((-1e-3, 5e-4), 5.0), ((1e-9, 2e-9), 5.0),
            ((-40.0, 7.0), 5.0), ((3e-5, 3e-5), 0.5),
        ),
    },
    {  # one element is a Jenkin element; the pressure goes and comes back
        "props": [0.3, 1, 2e5, 1.0],
        "path": _path(
            ((1e-5, 2e-5), 30.0), ((1e-5, -1e-5), 10.0), ((1e-5, 0.0), 0.0), ((0.0, 0.0), 0.0),
            ((1e-6, 1e-6), 10.0), ((1e9, 1e9), 10.0),
        ),
    },
    {"props": [0.4, 2, 1e-3, 1e9, 0.0, 1.0], "path": _path(((1e-30, 0.0), 2.0), ((1.0, 2.0), 3.0))},
]  # fmt: skip
