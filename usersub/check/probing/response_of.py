# SPDX-License-Identifier: MIT
"""What kind of friction a routine gives, found out from its answers alone.

Rules of mechanics hold for some laws and not for others; whether they do is asked here, by sliding
a point that was never moved before in simple ways.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from usersub.check import cases
from usersub.check.rule import COEFFICIENT, CannotCheck, NotApplicable

if TYPE_CHECKING:
    from usersub.check.case import Case, Step
    from usersub.check.respond.answer import Answer
    from usersub.check.subject import Subject

#: Multiplier over load that makes a point which sticks by Lagrange multipliers slip.
_PULL = 1e4
#: Numbers of iterations that are tried one after the other where a point still sticks.
_ITERATIONS = (2, 1, 3)
#: Increments of the paths that are asked for here.
_INCREMENTS = 4
#: Motion over the slip scale that is next to none.
_TINY = 1e-9


def tolerance(subject: Subject) -> float:
    """Relative difference that is more than rounding and differences of formulas."""
    return 1e-6 if subject.precision == "double" else 1e-3


def ask(subject: Subject, case: Case, **options: object) -> list[Answer]:
    """Answers to a case.

    Raises:
        CannotCheck: the routine failed; the message says how.
    """
    answers = subject.respond(case, **options)
    if answers and answers[-1].failure is not None:
        raise CannotCheck(f"the routine failed in increment {len(answers)}: {answers[-1].failure}")
    return answers


def slide(subject: Subject, case: Case, *, need: bool = True) -> list[Answer]:
    """Answers of a point that slides: one that sticks by multipliers is pulled until it slips.

    Args:
        need: whether friction is needed, so that a law without any does not pass for nothing.

    Raises:
        NotApplicable: it sticks whatever the multiplier (LM = 1), or there is no friction.
        CannotCheck: the routine failed.
    """
    answers = ask(subject, case)
    if _sticks(case, answers):
        answers = _let_go(subject, pulled(subject, case))
    if need and not any(np.any(a.friction) for a in answers if a.friction is not None):
        raise NotApplicable("the routine gives no friction here, see friction.present")
    return answers


def _let_go(subject: Subject, case: Case) -> list[Answer]:
    """Answers to a case with multipliers, each increment iterated until its points slip.

    A routine that was released may hold the point again in the iteration behind, where the host
    would give it other motions.
    """
    steps = list(case.steps)
    tries = {index: list(_ITERATIONS) for index in range(len(steps))}
    while True:
        made = case.but(steps=tuple(steps))
        answers = ask(subject, made)
        index = _first_that_sticks(made, answers)
        if index is None:
            return answers
        if not tries[index]:
            raise NotApplicable(
                f"the routine returns LM = 1 in increment {index + 1}, whatever the multiplier: "
                "the host allows no slip and finds the stress"
            )
        steps[index] = replace(steps[index], iterations=tries[index].pop(0))


def pulled(subject: Subject, case: Case) -> Case:
    """The case with multipliers along the motion that no friction can bear."""
    return case.but(steps=tuple(_pulled(subject, s) for s in case.steps))


def _pulled(subject: Subject, step: Step) -> Step:
    length = [math.hypot(*m) for m in step.motion]
    force = _PULL * max(subject.scales.load, *(abs(p) for p in step.load))
    multiplier = tuple(
        tuple(force * c / size if size > 0 else 0.0 for c in m)
        for m, size in zip(step.motion, length, strict=True)
    )
    return replace(step, multiplier=multiplier, iterations=max(step.iterations, 2))


def _sticks(case: Case, answers: Sequence[Answer]) -> bool:
    return _first_that_sticks(case, answers) is not None


def _first_that_sticks(case: Case, answers: Sequence[Answer]) -> int | None:
    """The first increment behind the touch in which a point that moves has LM = 1."""
    for index, (answer, step) in enumerate(zip(answers, case.steps, strict=False)):
        moves = np.any(np.array(step.motion) != 0, axis=1)
        if index and answer.lm is not None and np.any((answer.lm == 1) & moves):
            return index
    return None


def friction(answers: Sequence[Answer]) -> np.ndarray:
    """Friction of all increments, shape (increments, F, N)."""
    return np.array([a.friction for a in answers])


def motions(case: Case) -> np.ndarray:
    """Motion of all increments, shape (increments, F, N)."""
    return np.array([np.array(s.motion).T for s in case.steps])


def straight(
    subject: Subject,
    angle: float,
    sizes: Sequence[float] = (1.0,) * _INCREMENTS,
    **more: object,
) -> Case:
    """A point touches and is moved one way, by `sizes` in units of the slip scale."""
    way = cases.direction(angle)
    path = [(size * way[0], size * way[1]) for size in sizes]
    return cases.history(subject, path, **more)  # type: ignore[arg-type]


def turned(subject: Subject, case: Case, angle: float) -> Case:
    """The case in another direction of the plane; answers should have the same numbers."""
    if subject.interface.name not in COEFFICIENT:
        return case.but(angle=case.angle + angle)
    c, s = math.cos(angle), math.sin(angle)
    return moved(case, lambda m: (c * m[0] - s * m[1], s * m[0] + c * m[1]))


def reversed_(case: Case) -> Case:
    """The case with all motions the other way."""
    return moved(case, lambda m: tuple(-c if c else 0.0 for c in m))


def moved(case: Case, change) -> Case:  # noqa: ANN001
    """The case with every motion changed by a function."""
    steps = tuple(replace(s, motion=tuple(change(m) for m in s.motion)) for s in case.steps)
    return case.but(steps=steps)


def preferred_directions(subject: Subject) -> str:
    """How friction differs between directions that are a quarter turn apart; "" where it does not.

    Friction that treats components one by one has the same size along both axes, and along both
    diagonals; it is a fault and no anisotropy.
    """
    found = {d: _end(subject, math.radians(d)) for d in (0, 90, 45, 135)}
    largest = max(found.values())
    for one, other in ((0, 90), (45, 135)):
        if abs(found[one] - found[other]) > tolerance(subject) * largest:
            return (
                f"friction is {found[one]:.6g} along {one} degrees and {found[other]:.6g} along "
                f"{other} degrees: the law has preferred directions"
            )
    return ""


def _end(subject: Subject, angle: float) -> float:
    answers = slide(subject, straight(subject, angle), need=False)
    return float(np.linalg.norm(answers[-1].friction[:, 0]))  # type: ignore[index]


@dataclass(frozen=True)
class Elasticity:
    """Whether friction is elastic at first: it brings its own stick, and stress stays in it."""

    elastic: bool
    sentence: str


def elasticity(subject: Subject) -> Elasticity:
    """Asks with next to no motion: before any other, and backwards after a slide.

    Friction of the Coulomb kind is whole at once and turns with the motion; viscous friction
    vanishes with the rate; friction that is elastic at first begins at zero and keeps its
    direction when the motion turns.
    """
    directions = cases.dimensions(subject)[0]
    ways = (1.0,) * 8
    there = straight(subject, 0.0, (*ways, -_TINY), directions=directions)
    first = straight(subject, 0.0, (_TINY,), directions=directions)
    slid = friction(slide(subject, there))[:, 0, 0]
    start = abs(float(friction(slide(subject, first, need=False))[-1, 0, 0]))
    reference, kept = slid[-2], slid[-1]
    begins_at_zero = start <= 1e-2 * abs(reference)
    keeps = reference != 0 and kept / reference > 0.1
    return Elasticity(
        bool(begins_at_zero and keeps),
        f"friction is {start:.3g} at the first touch of motion, {reference:.6g} after a slide and "
        f"{kept:.6g} when the motion has just turned: it is elastic at first and brings its own "
        "stick",
    )


def alike(case: Case, subject: Subject) -> Case:
    """The case with the same temperatures, fields and areas at all points."""
    n, scales = case.points, subject.scales
    base = scales.temperature
    values = scales.fields or (0.5,) * subject.fields
    common = {
        "temperature": ((base, base + 3.0),) * n if subject.temperatures else None,
        "fields": ((values, values),) * n if subject.fields else None,
        "area": (1.0,) * n if subject.interface.solver == "explicit" else None,
    }
    steps = []
    for step in case.steps:
        missing = {k: v for k, v in common.items() if v is not None and getattr(step, k) is None}
        steps.append(replace(step, **missing))  # type: ignore[arg-type]
    return case.but(steps=tuple(steps))
