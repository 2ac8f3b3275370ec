# SPDX-License-Identifier: MIT
"""Nothing moves, no area, no time: finite answers and no friction out of nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.probing.response_of import friction, motions, preferred_directions, tolerance
from usersub.check.respond.answer import Answer
from usersub.check.respond.explicit import AMPLE
from usersub.check.rule import FRICTION, CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.figures import values
from usersub.check.subject import Subject
from usersub.driver.status import VALUES
from usersub.errors import Error, RoutineError

_DIVISION = "look before every division by the {what} whether it is zero"
_WAY = (0.8, 0.6)
#: Decades below the scale of time in which a slide without time is looked at too.
_TIMES = {"double": range(-4, 31, 2), "single": range(-4, 13, 2)}


def not_finite(answer: Answer) -> str:
    """What of an answer is NaN or infinite, in words; "" if nothing is."""
    failure = answer.failure
    if failure is not None:
        return str(failure) if failure.status == VALUES["NOT_FINITE"] else ""
    for name, array in answer.arrays().items():
        if not np.all(np.isfinite(array)):
            bad = array[~np.isfinite(array)][0]
            return f"{name} = {bad}"
    if answer.pnewdt is not None and np.isnan(answer.pnewdt):
        return "PNEWDT = nan"
    return ""


def finite(
    subject: Subject, case: Case, when: str, what: str, applies: Callable[[Step], bool]
) -> Finding | None:
    """Says what is not finite in an increment to which the rule applies.

    Raises:
        NotApplicable: the routine refuses such an increment.
        CannotCheck: it failed otherwise.
    """
    answers = subject.respond(case)
    for index, answer in enumerate(answers):
        if not applies(case.steps[index]):
            continue
        bad = not_finite(answer)
        if bad:
            return Finding(
                f"{when} in increment {index + 1}: {bad}; expected finite values",
                hint=_DIVISION.format(what=what),
                figures={"step": index, "point": 0},
            )
        if answer.failure is not None:
            raise _refused(answer.failure, when)
    failure = answers[-1].failure
    if failure is not None:
        raise CannotCheck(f"the routine failed in increment {len(answers)}: {failure}")
    return None


def _refused(failure: Error, when: str) -> Exception:
    if isinstance(failure, RoutineError) and failure.status in (
        VALUES["ROUTINE_RAISED"],
        VALUES["ROUTINE_STOPPED"],
    ):
        return NotApplicable(f"the routine refuses it ({when}): {failure}")
    return CannotCheck(f"{when}: {failure}")


def _still(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        yield cases.history(subject, [(0.0, 0.0)] * 2, directions=directions)
        path = [_WAY] * 4 + [(0.0, 0.0)] * 2
        yield cases.history(subject, path, directions=directions)


@rule(
    "zero.slip",
    "Without motion the answers are finite, and no friction comes from nothing.",
    reference="a point that does not move has DGAM = 0, dSlipFric = 0 or a slip rate of zero; "
    "directions are then arbitrary",
    cases=_still,
)
def slip(subject: Subject, case: Case) -> Finding | None:
    """No motion since the touch, and no motion after a slide."""
    found = finite(
        subject,
        case,
        "without motion",
        "size of the motion",
        lambda s: not any(any(m) for m in s.motion),
    )
    if found is not None or subject.interface.name != "fric":
        return found
    answers = subject.respond(case)
    if answers[-1].lm is not None and np.any(answers[-1].lm):
        return None
    whole, way = friction(answers)[..., 0], motions(case)[..., 0]
    scale = subject.scales.load
    if not np.any(way):
        if np.linalg.norm(whole[-1]) > tolerance(subject) * scale:
            return Finding(
                f"TAU is {values(whole[-1])} at a point that has never moved; expected 0",
                hint="without motion there is no friction stress: let it grow from the elastic "
                "slip, or from the slip rate",
                figures={"step": len(case.steps) - 1, "point": 0},
            )
        return None
    return _along(subject, case, whole, way)


def _along(subject: Subject, case: Case, whole: np.ndarray, way: np.ndarray) -> Finding | None:
    """After a straight slide, what is left without motion is on the line of the slide."""
    moved = way[np.any(way != 0, axis=1)]
    unit = moved[0] / np.linalg.norm(moved[0])
    straight = np.allclose(moved, (moved @ unit)[:, None] * unit, rtol=0, atol=1e-9)
    if way.shape[1] < 2 or np.any(way[-1]) or not straight:
        return None
    off = np.linalg.norm(whole[-1] - (whole[-1] @ unit) * unit)
    largest = np.max(np.abs(whole))
    if off <= 1e-3 * largest or preferred_directions(subject):
        return None
    return Finding(
        f"TAU is {values(whole[-1])} in an increment without motion after a slide along "
        f"{values(unit)}; expected it along the slide, or 0",
        hint="do not take a direction from a motion of size zero; keep that of the elastic slip",
        figures={"step": len(case.steps) - 1, "point": 0},
    )


def _no_area(subject: Subject) -> Iterator[Case]:
    made = cases.history(subject, [_WAY] * 2)
    steps = [replace(s, area=(1.0,)) for s in made.steps]
    steps[-1] = replace(steps[-1], area=(0.0,))
    yield made.but(steps=tuple(steps))


@rule(
    "zero.area",
    "With a contact area of zero the answers are finite.",
    reference="the contact area is 1 or a nominal one at edges and node-based surfaces; published "
    "code guards against zero",
    severity="warning",  # no host is known to hand over such an area
    interfaces=("vfric", "vfriction"),
    cases=_no_area,
)
def area(subject: Subject, case: Case) -> Finding | None:
    """The last increment has no area."""
    return finite(
        subject, case, "with a contact area of 0", "contact area", lambda s: s.area == (0.0,)
    )


def _no_time(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        moving = cases.history(subject, [_WAY], directions=directions)
        for made in (cases.history(subject, [(0.0, 0.0)], directions=directions), moving):
            steps = tuple(replace(s, dt=0.0) for s in made.steps)
            yield made.but(steps=steps)


@rule(
    "zero.time-step",
    "A time increment of zero gives finite answers.",
    reference="in the first increment of a step the time increment can be zero",
    interfaces=FRICTION,
    cases=_no_time,
)
def time_step(subject: Subject, case: Case) -> Finding | None:
    """All increments have no time, without and with motion."""
    found = finite(
        subject, case, "with a time increment of 0", "time increment", lambda s: s.dt == 0
    )
    return found or _cut_off(subject, case)


def _cut_off(subject: Subject, case: Case) -> Finding | None:
    """A slide (explicit) whose friction is the stick force without time, and far from it in any
    time: MIN of NaN or of infinity and the stick force is the stick force."""
    load = abs(case.steps[-1].load[0])
    if subject.interface.solver != "explicit" or any(s.dt for s in case.steps) or not load:
        return None
    size, stick = _last_size(subject, case), AMPLE * load
    if size is None or size < 0.99 * stick:
        return None
    times = [subject.scales.dt * 10.0**-k for k in _TIMES[subject.precision]]
    others = [
        _last_size(subject, case.but(steps=tuple(replace(s, dt=t) for s in case.steps)))
        for t in times
    ]
    most = max((o for o in others if o is not None), default=stick)
    if None in others or most > stick / 3.0:
        return None
    return Finding(
        f"with a time increment of 0 friction is the stick force, {size:.6g}; the same motion in "
        f"any other time has {most:.6g} at most: MIN has hidden that the rate is no number",
        hint=_DIVISION.format(what="time increment"),
    )


def _last_size(subject: Subject, case: Case) -> float | None:
    answer = subject.respond(case)[-1]
    if answer.failure is not None or answer.friction is None:
        return None
    return float(np.linalg.norm(answer.friction[:, 0]))
