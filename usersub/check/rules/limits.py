# SPDX-License-Identifier: MIT
"""Limits of a law: friction at rest against friction at the highest rates."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.response_of import slide
from usersub.check.rule import COEFFICIENT, Finding, NotApplicable, rule
from usersub.check.rules.figures import number
from usersub.check.subject import Subject

#: Powers of ten by which rates go up and down from that of the scales.
_DECADES = range(-14, 15, 2)
#: Stick force (explicit): a law that grows without end must not seem to have a limit.
_BOUNDLESS = 1e30


def _rates(subject: Subject) -> Iterator[Case]:
    """A touch and one slide; the judge changes its time."""
    directions = cases.dimensions(subject)[0]
    yield cases.history(subject, [(1.0, 0.0)], directions=directions)


@rule(
    "limits.rate",
    "Friction that has a limit at rest and one at high rates is higher at rest.",
    reference="static friction is above kinetic friction; exponential laws are written with their "
    "limits exchanged",
    severity="warning",
    cases=_rates,
)
def rate(subject: Subject, case: Case) -> Finding | None:
    """The same slide in times over many orders of magnitude."""
    if subject.law:
        raise NotApplicable(f"the law {subject.law} says what its limits are, see law.agrees")
    found = {}
    for decade in _DECADES:
        dt = case.steps[-1].dt * 10.0**-decade
        last = replace(case.steps[-1], dt=dt, stick=(_BOUNDLESS,) * case.points)
        found[decade] = _size(subject, case.but(steps=(*case.steps[:-1], last)))
    sizes = [found[d] for d in _DECADES]
    rest, infinite = sizes[0], sizes[-1]
    if not _settled(sizes[:2]) or not _settled(sizes[-2:]):
        raise NotApplicable("friction has no limit at rest or none at high rates")
    if not 0 < rest < infinite * (1.0 - 1e-6):
        return None
    what = "the coefficient" if subject.interface.name in COEFFICIENT else "friction"
    return Finding(
        f"{what} rises from {number(rest)} at rest to {number(infinite)} at high slip rates and "
        "stays there; expected the value at rest to be the higher one",
        hint="see whether static and kinetic value are exchanged: mu = muk + (mus - muk) "
        "exp(-dc rate)",
        figures={"step": len(case.steps) - 1, "point": 0, "sizes": sizes},
    )


def _settled(pair: list[float]) -> bool:
    return abs(pair[1] - pair[0]) <= 1e-6 * max(abs(p) for p in pair)


def _size(subject: Subject, case: Case) -> float:
    answers = slide(subject, case, need=False)
    last = answers[-1]
    if last.coefficient is not None and last.friction is None:
        return float(last.coefficient[0])
    assert last.friction is not None
    return float(np.linalg.norm(last.friction[:, 0]))
