# SPDX-License-Identifier: MIT
"""Histories of motion and load, a point for each value of what is unusual."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from usersub.study.stability.subjects import Subject

#: Directions of the increments of the ordinary history, in slips.
WAY = ((0.8, 0.6), (0.8, 0.6), (0.0, 0.0), (-0.8, -0.6), (-0.08, 0.06), (0.0, 1.0), (-1.0, 0.0))


@dataclass
class History:
    """Increments of N points.

    Attributes:
        case, values: name, and a word for each point.
        motion: shape (increments, 2, N).
        load: pressures, shape (increments, N).
        dt: time increments, shape (increments,).
        temperature: shape (N,).
        stick, mass: explicit: what the host gives, shape (N,); None: ordinary ones.
        subject: as changed by the case.
        refused: why there is nothing to run, else "".
        valid: whether the law itself allows its properties; a host can give others.
        repeats: how often the increments are run.
        period: of the increments after the first, in increments; 0 where there is none.
    """

    case: str
    values: list[str]
    subject: Subject
    motion: np.ndarray
    load: np.ndarray
    dt: np.ndarray
    temperature: np.ndarray
    stick: np.ndarray | None = None
    mass: np.ndarray | None = None
    refused: str = ""
    valid: bool = True
    repeats: int = 1
    period: int = 0

    @property
    def points(self) -> int:
        """Number of points."""
        return len(self.values)


def history_of(
    subject: Subject,
    case: str,
    values: Sequence[str],
    *,
    slip: np.ndarray | float = 1.0,
    load: np.ndarray | float = 1.0,
    way: Sequence[tuple[float, float]] = WAY,
    dt: float = 0.1,
    temperature: np.ndarray | float | None = None,
) -> History:
    """The ordinary history with factors: of slip and load (N,) or (increments, N), of the time."""
    n, scales = len(values), subject.scales
    steps = len(way)
    factor = np.broadcast_to(np.asarray(slip, float) * scales.slip, (steps, n))
    motion = np.asarray(way)[:, :, np.newaxis] * factor[:, np.newaxis, :]
    loads = np.broadcast_to(np.asarray(load, float) * scales.load, (steps, n)).copy()
    warm = scales.temperature if temperature is None else temperature
    return History(
        case=case,
        values=list(values),
        subject=subject,
        motion=motion,
        load=loads,
        dt=np.full(steps, dt * scales.time),
        temperature=np.broadcast_to(np.asarray(warm, float), n).copy(),
    )


def refused(subject: Subject, case: str, values: list[str], why: str) -> History:
    history = history_of(subject, case, values)
    history.refused = why
    return history
