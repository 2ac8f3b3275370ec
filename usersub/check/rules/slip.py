# SPDX-License-Identifier: MIT
"""DSLIP: the slip of an increment that friction does not give back."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from usersub.check.case import Case
from usersub.check.probing.response_of import (
    friction,
    motions,
    preferred_directions,
    slide,
    straight,
)
from usersub.check.respond.answer import Answer
from usersub.check.rule import Finding, NotApplicable, rule
from usersub.check.rules.figures import number, values
from usersub.check.subject import Subject

#: Relative change of stress below which sliding is steady.
_STEADY = 1e-9
_LONG = 12


def _slides(subject: Subject) -> Iterator[Case]:
    for directions in (1, 2):
        for degrees in (0.0, 40.0, 180.0) if directions == 2 else (0.0, 180.0):
            yield straight(subject, math.radians(degrees), (1.0,) * _LONG, directions=directions)
            growing = [1.5**k for k in range(-6, 6)]
            yield straight(subject, math.radians(degrees), growing, directions=directions)


def given(subject: Subject, case: Case, answers: list[Answer]) -> np.ndarray:
    """DSLIP of all increments, shape (increments, F, N).

    Raises:
        NotApplicable: it is never set.
    """
    found = np.array([a.dslip for a in answers])
    if not np.any(found):
        raise NotApplicable("the routine never sets DSLIP, which is optional")
    return found


@rule(
    "slip.sign",
    "DSLIP of a straight slide points along the motion.",
    reference="DSLIP is the increment of sliding that is not recovered; output and SLIP are made "
    "of it",
    interfaces=("fric",),
    cases=_slides,
)
def sign(subject: Subject, case: Case) -> Finding | None:
    """Straight slides of a point that was never moved before."""
    answers = slide(subject, case, need=False)
    slip, way = given(subject, case, answers), motions(case)
    for step in range(len(case.steps)):
        for point in range(case.points):
            d, x = slip[step, :, point], way[step, :, point]
            length = np.linalg.norm(x)
            if not np.any(d) or not length or _uncounted(answers[step], point):
                continue
            along = float(d @ x / length)
            across = float(np.linalg.norm(d - along * x / length))
            wrong = along < 0
            if not wrong and across > 1e-6 * length:
                wrong = not preferred_directions(subject)
            if wrong:
                return Finding(
                    f"DSLIP is {values(d)} in increment {step + 1} of a straight slide, whose "
                    f"motion is {values(x)}; expected it along the motion",
                    hint="DSLIP is the motion of the increment less the change of elastic slip, "
                    "with its sign",
                    figures={"step": step, "point": point},
                )
    return None


@rule(
    "slip.size",
    "DSLIP is the slip of this increment: never more than the motion, all of it in steady sliding.",
    reference="the host adds DSLIP of every increment to SLIP",
    interfaces=("fric",),
    cases=_slides,
)
def size(subject: Subject, case: Case) -> Finding | None:
    """Straight slides of a point that was never moved before."""
    answers = slide(subject, case, need=False)
    slip, way, stress = given(subject, case, answers), motions(case), friction(answers)
    moved = slid = np.zeros(case.points)
    for step in range(len(case.steps)):
        if _uncounted(answers[step], 0):
            continue
        length, slipped = (np.linalg.norm(v[step], axis=0) for v in (way, slip))
        moved, slid = moved + length, slid + slipped
        for point in range(case.points):
            most = number(float(length[point]))
            told = None
            lost = float(slip[step, :, point] @ stress[step, :, point])
            done = float(way[step, :, point] @ stress[step, :, point])
            if lost > 1e-3 * done and _stored(answers, way, stress, step, point):
                told = "0: SED says that all the work so far is elastic"
            elif slid[point] > moved[point] * (1.0 + 1e-6):
                told = f"at most {most}, its size"
            elif _steady(stress, step, point) and _unlike(slipped[point], length[point]):
                told = f"{most}, its size: the stress is steady, so no motion is elastic"
            if told:
                return Finding(
                    f"DSLIP has the size {number(float(slipped[point]))} in increment {step + 1} "
                    f"of a straight slide, whose motion is {values(way[step, :, point])}; expected "
                    f"{told}",
                    hint="DSLIP is the part of DGAM of this increment that is not recovered: "
                    "neither a rate nor the sum of all increments",
                    figures={"step": step, "point": point},
                )
    return None


def _stored(
    answers: list[Answer], way: np.ndarray, stress: np.ndarray, step: int, point: int
) -> bool:
    """Whether SED is half of the stress times all the motion so far."""
    sed = answers[step].sed
    half = 0.5 * float(stress[step, :, point] @ np.sum(way[: step + 1, :, point], axis=0))
    return sed is not None and half > 0 and abs(float(sed[point]) - half) <= 1e-6 * half


def _uncounted(answer: Answer, point: int) -> bool:
    return answer.lm is not None and bool(answer.lm[point])


def _steady(stress: np.ndarray, step: int, point: int) -> bool:
    """Whether stress is as in the two increments before, and is there at all."""
    if step < 2:
        return False
    now, before = stress[step, :, point], stress[step - 2 : step, :, point]
    largest = np.linalg.norm(now)
    return bool(largest > 0 and np.max(np.abs(before - now)) <= _STEADY * largest)


def _unlike(one: float, other: float) -> bool:
    return abs(one - other) > 1e-3 * other
