# SPDX-License-Identifier: MIT
"""What a routine answered in one increment, the same for all interfaces."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from usersub.errors import Error


@dataclass(frozen=True)
class Answer:
    """One increment of N points with F friction directions; None where the interface has no such.

    Attributes:
        friction: stress (FRIC) or force (VFRIC, VFRICTION), positive along the sliding motion,
            components in the directions of the case, shape (F, N).
        coefficient, second: friction coefficients, shape (N,).
        tangent: derivative of friction (first index) by motion (second), shape (F, F, N).
        by_pressure: derivative of friction by pressure, shape (F, N).
        by_temperature: derivative of friction by the two temperatures, shape (F, 2, N).
        derivative: of the coefficient by slip rate, pressure and temperature, shape (3, N).
        lm, dslip, sed, sfd: as in FRIC, shapes (N,), (F, N), (N,), (N,).
        pnewdt: smallest suggested over current time increment.
        state: state variables at the end of the increment, the point is the last index.
        failure: why there is no answer.
    """

    friction: np.ndarray | None = None
    coefficient: np.ndarray | None = None
    second: np.ndarray | None = None
    tangent: np.ndarray | None = None
    by_pressure: np.ndarray | None = None
    by_temperature: np.ndarray | None = None
    derivative: np.ndarray | None = None
    lm: np.ndarray | None = None
    dslip: np.ndarray | None = None
    sed: np.ndarray | None = None
    sfd: np.ndarray | None = None
    pnewdt: float | None = None
    state: np.ndarray | None = None
    failure: Error | None = None

    def arrays(self) -> dict[str, np.ndarray]:
        """The arrays that there are, by name."""
        found = {f.name: getattr(self, f.name) for f in fields(self)}
        return {k: v for k, v in found.items() if isinstance(v, np.ndarray)}

    def of(self, points: list[int]) -> Answer:
        """The answer for some of the points, in the order given."""
        cut = {name: array[..., points] for name, array in self.arrays().items()}
        return Answer(**cut, pnewdt=self.pnewdt, failure=self.failure)


def different(one: Answer, other: Answer, skip: tuple[str, ...] = ()) -> tuple[str, int] | None:
    """Name of the first array whose bits differ, and the point; None if there is none.

    NaN equals NaN, and zeros of both signs are equal.
    """
    for name, array in one.arrays().items():
        twin = getattr(other, name)
        if name in skip or twin is None:
            continue
        unlike = ~((array == twin) | (np.isnan(array) & np.isnan(twin)))
        if unlike.any():
            return name, int(np.argwhere(unlike)[0][-1])
    if one.pnewdt != other.pnewdt and "pnewdt" not in skip:
        return "pnewdt", 0
    return None
