# SPDX-License-Identifier: MIT
"""Elastic slip without a bound, in arbitrary precision."""


def update(q, props):
    """Traction, elastic slip and no scalars at the end of the increment."""
    elastic = tuple(e + m for e, m in zip(q.vectors[0], q.motion, strict=True))
    return tuple(props[0] * e for e in elastic), (elastic,), ()


CASES = [
    {
        "props": [slope],
        "path": [
            {"motion": [0.3, -0.2], "pressure": 800.0},
            {"motion": [0.0, 0.0], "pressure": 0.0},
            {"motion": [9.0, 7.0], "pressure": 1300.0},
            {"motion": [-40.0, 3.0], "pressure": 5.0},
            {"motion": [1e-9, 2e-9], "pressure": 900.0},
            {"motion": [1e9, -2e9], "pressure": 900.0},
        ],
    }
    for slope in (2e5, 0.03)
]
