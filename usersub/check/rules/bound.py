# SPDX-License-Identifier: MIT
"""Bounds of friction: the cone, the stick force, the direction, a coefficient above zero."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.response_of import (
    ask,
    elasticity,
    friction,
    motions,
    slide,
    straight,
    tolerance,
)
from usersub.check.rule import COEFFICIENT, FRICTION, Finding, NotApplicable, rule
from usersub.check.rules.cone import WINDING, cone
from usersub.check.rules.figures import number, values
from usersub.check.subject import Subject

__all__ = ["coefficient", "cone", "opposes_slip", "stick_force"]


def _limited(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        made = cases.history(subject, [(1.0, 0.0), (0.5, 0.4), (-0.6, 0.2)], directions=directions)
        for limit in (1e-3, 0.0, 0.05):
            stick = tuple(limit * p for p in made.steps[0].load)
            yield made.but(steps=tuple(replace(s, stick=stick) for s in made.steps))
        for made in cases.loaded(subject, [(1.0, 0.0), (0.5, 0.4)], directions):
            steps = (replace(s, stick=tuple(1e-2 * p for p in s.load)) for s in made.steps)
            yield made.but(steps=tuple(steps))


@rule(
    "bound.stick-force",
    "The friction force is at most the stick force.",
    reference="0 >= fTangential(1) >= -fStickForce: more would turn the motion back",
    interfaces=("vfric", "vfriction"),
    cases=_limited,
)
def stick_force(subject: Subject, case: Case) -> Finding | None:
    """A stick force far below friction, and none."""
    answers = ask(subject, case)
    whole = friction(answers)
    allowed = 1e-9 if subject.precision == "double" else 1e-5
    for step, s in enumerate(case.steps):
        for point, limit in enumerate(s.stick or ()):
            along = float(np.linalg.norm(whole[step, :, point]))
            if along <= limit * (1.0 + allowed) + allowed * abs(s.load[point]):
                continue
            _bring_own_stick(subject)
            return Finding(
                f"the friction force is {number(along)} in increment {step + 1}; expected at most "
                f"{number(limit)}, the stick force",
                hint="take the smaller of the friction force and fStickForce",
                figures={"step": step, "point": point},
            )
    return None


def _bring_own_stick(subject: Subject) -> None:
    found = elasticity(subject)
    if found.elastic:
        raise NotApplicable(found.sentence)


def _ways(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        for degrees in (0.0, 60.0, 180.0) if directions == 2 else (0.0, 180.0):
            yield straight(subject, math.radians(degrees), directions=directions)
        yield cases.history(subject, WINDING, directions=directions)
        yield from cases.loaded(subject, [(1.0, 0.0), (1.0, 0.0)], directions)


@rule(
    "bound.opposes-slip",
    "Friction acts against the slip.",
    reference="fTangential(1) is negative or zero; TAU has the sign of the sliding motion that it "
    "acts against",
    interfaces=FRICTION,
    cases=_ways,
)
def opposes_slip(subject: Subject, case: Case) -> Finding | None:
    """Straight slides; winding ones too where friction has no memory of a direction."""
    answers = slide(subject, case, need=False)
    explicit = subject.interface.solver == "explicit"
    steps = range(len(answers)) if explicit else range(_turns_at(case))
    for step in steps:
        if answers[step].lm is not None and np.any(answers[step].lm == 1):  # type: ignore[arg-type]
            continue
        found, motion = friction(answers)[step], motions(case)[step]
        for point in range(case.points):
            length = float(np.linalg.norm(motion[:, point]))
            if not length:
                continue
            along = float(found[:, point] @ motion[:, point]) / length
            if along >= -tolerance(subject) * abs(case.steps[step].load[point]):
                continue
            if step >= _turns_at(case):
                _bring_own_stick(subject)
            return _pushes(subject, case, step, point, along)
    return None


def _turns_at(case: Case) -> int:
    """The first increment that does not go the way of the first motion."""
    first = None
    for index, motion in enumerate(motions(case)[:, :, 0]):
        if not np.any(motion):
            if first is not None:
                return index
            continue
        unit = motion / np.linalg.norm(motion)
        if first is None:
            first = unit
        elif first @ unit < 1.0 - 1e-9:
            return index
    return len(case.steps)


def _pushes(subject: Subject, case: Case, step: int, point: int, along: float) -> Finding:
    if subject.interface.solver == "explicit":
        detail = (
            f"fTangential(1) = {number(-along)} in increment {step + 1} pushes along the slip; "
            "expected 0 or less"
        )
        hint = "direction 1 is that of the slip: fTangential(1) is minus the size of friction"
    else:
        motion = case.steps[step].motion[point]
        detail = (
            f"TAU has the component {number(along)} along the motion {values(motion)} in increment "
            f"{step + 1}; expected 0 or more"
        )
        hint = "behind FRIC the stress has the sign of the sliding motion (that of DGAM)"
    return Finding(detail, hint=hint, figures={"step": step, "point": point})


def _sweep(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        for load in (1.0, 1e-3, 1e3):
            sizes = [0.0, *(10.0**k for k in range(-6, 9, 2))]
            yield straight(subject, 0.5, sizes, load=load, directions=directions)


@rule(
    "bound.coefficient",
    "The coefficient is not negative.",
    reference="a negative coefficient drives the motion that it should brake",
    interfaces=COEFFICIENT,
    cases=_sweep,
)
def coefficient(subject: Subject, case: Case) -> Finding | None:
    """Slip rates and pressures over many orders of magnitude."""
    for step, answer in enumerate(ask(subject, case)):
        for name, array in (("coefficient", answer.coefficient), ("second", answer.second)):
            if array is None or (name == "second" and not subject.anisotropic):
                continue
            point = int(np.argmin(array))
            if not array[point] >= 0:
                s = case.steps[step]
                rate = math.hypot(*s.motion[point]) / s.dt
                which = "second coefficient" if name == "second" else "coefficient"
                return Finding(
                    f"the {which} is {number(float(array[point]))} at slip rate {number(rate)} and "
                    f"pressure {number(s.load[point])}; expected 0 or more",
                    hint="look at the limits of the formula at high rates and pressures, and do "
                    "not let it fall below 0",
                    figures={"step": step, "point": point},
                )
    return None
