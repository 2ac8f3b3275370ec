# SPDX-License-Identifier: MIT
"""Rates: friction at rest against friction at the highest rates, and what a rate is made of."""

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
    "Slip rates are made with the time increment; friction with a limit at rest and one at high "
    "rates is higher at rest.",
    reference="static friction is above kinetic friction; exponential laws are written with their "
    "limits exchanged. The slip that a routine is given is that of the increment, not of the step",
    severity="warning",
    cases=_rates,
)
def rate(subject: Subject, case: Case) -> Finding | None:
    """The same slide in times over many orders of magnitude."""
    if subject.law:
        raise NotApplicable(f"the law {subject.law} says what its limits are, see law.agrees")
    if subject.interface.name not in COEFFICIENT and _by_step_time(subject, case):
        return Finding(_BY_STEP_TIME, hint=_INCREMENT)
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


_BY_STEP_TIME = (
    "friction depends on the slip of the increment over the step time: it stays the same if both "
    "are doubled, changes with either of them, and not with the time increment"
)
_INCREMENT = (
    "divide the slip of the increment by the time increment: DGAM by DTIME, dSlipFric by dTimCur "
    "or rData(3)"
)


def _by_step_time(subject: Subject, case: Case) -> bool:
    """Whether a slide shows a rate that is made with the time of the step."""

    def sizes(*changes: tuple[float, float, float]) -> list[float]:
        """Friction with the motion, the time before it and its own time times these."""
        found = []
        for motion, before, own in changes:
            *firsts, last = case.steps
            firsts = [replace(s, dt=s.dt * before) for s in firsts]
            moved = tuple(tuple(c * motion for c in m) for m in last.motion)
            last = replace(last, motion=moved, dt=last.dt * own, stick=(_BOUNDLESS,) * case.points)
            found.append(_size(subject, case.but(steps=(*firsts, last))))
        return found

    before, own = (sum(s.dt for s in part) for part in (case.steps[:-1], case.steps[-1:]))
    shift = 1.0 + 0.5 * own / before  # half of the last increment's time goes to those before
    first, both, other, longer, farther = sizes(
        (1.0, 1.0, 1.0), (2.0, 2.0, 2.0), (1.0, shift, 0.5), (1.0, 2.0, 2.0), (2.0, 1.0, 1.0)
    )
    same = all(abs(s - first) <= 1e-9 * first for s in (both, other))
    return same and all(abs(s - first) > 1e-4 * first for s in (longer, farther))


def _settled(pair: list[float]) -> bool:
    return abs(pair[1] - pair[0]) <= 1e-6 * max(abs(p) for p in pair)


def _size(subject: Subject, case: Case) -> float:
    answers = slide(subject, case, need=False)
    last = answers[-1]
    if last.coefficient is not None and last.friction is None:
        return float(last.coefficient[0])
    assert last.friction is not None
    return float(np.linalg.norm(last.friction[:, 0]))
