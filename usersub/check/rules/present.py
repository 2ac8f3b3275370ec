# SPDX-License-Identifier: MIT
"""There is friction: rules of size prove nothing about a routine that gives none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.response_of import ask, slide
from usersub.check.respond.answer import Answer
from usersub.check.rule import COEFFICIENT, Finding, NotApplicable, rule
from usersub.check.subject import Subject
from usersub.check.subjects.law_subject import recognised

#: Increments at the end in which it has to slide.
_LEAST = 2
_WAYS = ((1.0, 0.0), (0.0, 1.0))
#: Factors on load and motion: a law may have a threshold.
_HEAVIER = (1.0, 1e3)


def _sliding(subject: Subject) -> Iterator[Case]:
    directions = cases.dimensions(subject)[0]
    for way in _WAYS if directions == 2 else _WAYS[:1]:
        yield cases.history(subject, [way] * 4, directions=directions)


@rule(
    "friction.present",
    "A point that slides under load has friction, whatever the direction.",
    reference="a test of friction proves nothing where the coefficient is zero",
    severity="warning",
    cases=_sliding,
)
def present(subject: Subject, case: Case) -> Finding | None:
    """Slides along both directions; also under a thousand times the load."""
    if "frictionless" in (subject.law, recognised(subject.path)):
        raise NotApplicable("it stands for the law frictionless")
    if not all(any(s.motion[0]) and s.load[0] > 0 for s in case.steps[-_LEAST:]):
        return None
    name = "coefficient" if subject.interface.name in COEFFICIENT else "friction"
    for factor in _HEAVIER:
        answers = _answers(subject, _loaded(case, factor))
        if any(a.lm is not None and bool(np.all(a.lm == 2)) for a in answers[1:]):
            raise NotApplicable("the routine returns LM = 2: it declares the point frictionless")
        if any(np.any(getattr(a, name)) for a in answers):
            return None
    way = "" if case.directions == 1 else f" along ({_way(case)})"
    given = ", ".join(f"{p:g}" for p in subject.props) or "none"
    return Finding(
        f"{name} is 0 in all {len(case.steps)} increments of a slide{way}; expected some, "
        f"since rules about its size prove nothing (properties {given})",
        hint="give properties with which there is friction (--props), and see that the routine "
        "uses them, whatever the name of the interaction, and sets its output in every direction",
        figures={"step": len(case.steps) - 1, "point": 0},
    )


def _answers(subject: Subject, case: Case) -> list[Answer]:
    if subject.interface.name in COEFFICIENT:
        return ask(subject, case)
    return slide(subject, case, need=False)


def _loaded(case: Case, factor: float) -> Case:
    steps = tuple(replace(s, load=tuple(factor * p for p in s.load)) for s in case.steps)
    return case.but(steps=steps)


def _way(case: Case) -> str:
    motion = np.array(case.steps[-1].motion[0])
    size = np.linalg.norm(motion)
    return ", ".join(f"{c:.3g}" for c in (motion / size if size else motion))
