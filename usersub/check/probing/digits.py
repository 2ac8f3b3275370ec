# SPDX-License-Identifier: MIT
"""How many digits of a result are right: answers to inputs that differ by very little."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from usersub.check import cases

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject

#: Relative size of a step of all inputs together, and how many there are: several of the smallest
#: steps that single precision can make.
STEP, STEPS = 2.0**-28, 48

#: Motions and loads of the places that are looked at, in units of the scales.
_PLACES = ((1.0, 1.0), (0.83, 1.29), (1.31, 0.77))


def places(subject: Subject) -> Iterator[Case]:
    """Slip, and stick where there is any, at different motions and loads."""
    for slip, load in _PLACES:
        yield cases.history(subject, [(slip, 0.3 * slip)], load=load)
    if subject.scales.stick > 0:
        unit = 0.37 * subject.scales.stick
        yield cases.history(subject, [(1.0, 0.3)], unit=unit)


def answer(subject: Subject, case: Case) -> np.ndarray | None:
    """Friction, coefficients and state at the end of a case in one row; None if it fails."""
    last = subject.respond(case)[-1]
    if last.failure is not None:
        return None
    parts = (last.friction, last.coefficient, last.second, last.state)
    rows = [np.asarray(p, dtype=float).ravel() for p in parts if p is not None]
    return np.concatenate(rows) if rows else None


def shifted(subject: Subject, case: Case, step: int) -> Case:
    """The case with all its inputs, properties and temperatures larger by so many small steps."""
    factor = 1.0 + step * STEP
    scales = subject.scales

    def row(values: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(v * factor for v in values)

    more: dict[str, object] = {}
    if subject.temperatures:
        warm = factor * scales.temperature
        more["temperature"] = ((warm, warm),) * case.points
    if subject.fields:
        fields = row(scales.fields or (0.5,) * subject.fields)
        more["fields"] = ((fields, fields),) * case.points
    steps = tuple(
        replace(s, motion=tuple(row(m) for m in s.motion), load=row(s.load), **more)  # type: ignore[arg-type]
        for s in case.steps
    )
    return case.but(steps=steps, props=row(case.props if case.props is not None else subject.props))


@dataclass(frozen=True)
class Response:
    """Answers to steps of the input, one row a step."""

    rows: np.ndarray

    @property
    def size(self) -> np.ndarray:
        """Largest absolute value of each column; 1 where that is zero."""
        found = np.abs(self.rows).max(axis=0)
        return np.where(found > 0, found, 1.0)

    def roughness(self) -> float:
        """Largest second difference, as a fraction of the answer; rounding for a smooth answer in
        double precision, 1e-7 for one that went through single precision."""
        return float((np.abs(np.diff(self.rows, 2, axis=0)) / self.size).max(initial=0.0))


def jumps(ours: Response, theirs: Response) -> float:
    """Roughness of the difference of two answers: zero where both come from different constants,
    not where one of them is rounded on its way."""
    apart = np.abs(np.diff(ours.rows - theirs.rows, 2, axis=0))
    return float((apart / theirs.size).max(initial=0.0))


def response(subject: Subject, case: Case) -> Response | None:
    """Answers to a run of small steps; None if one of them fails."""
    rows = [answer(subject, shifted(subject, case, k)) for k in range(1, STEPS + 1)]
    if any(row is None for row in rows):
        return None
    return Response(np.array(rows))


def digits(error: float) -> float:
    """Number of correct digits of a relative error."""
    return -math.log10(error) if error > 0 else math.inf
