# SPDX-License-Identifier: MIT
"""SED and SFD of FRIC: energy that is stored and energy that is lost, against the work done."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.response_of import friction, motions, slide, straight
from usersub.check.respond.answer import Answer
from usersub.check.rule import Finding, NotApplicable, rule
from usersub.check.rules.figures import number
from usersub.check.subject import Subject

_ROUNDING = 1e-6
#: Load over the load scale: a missing factor of one would not be seen.
_LOAD = 1.7


def _slides(subject: Subject) -> Iterator[Case]:
    """Straight slides from next to no motion on; then one that comes back."""
    for directions in (1, 2):
        yield _fine(subject, directions)
        yield straight(subject, 0.4, (1.0,) * 10, load=_LOAD, directions=directions)
        yield straight(subject, 0.4, (1.0,) * 5 + (-1.0,) * 5, load=_LOAD, directions=directions)


def _fine(subject: Subject, directions: int) -> Case:
    """A slide whose increments are a fraction of the motion at which it begins to slip."""
    sizes = [10.0**k for k in np.arange(-7.0, 1.0, 0.25)]
    coarse = straight(subject, 0.4, sizes, load=_LOAD, directions=directions)
    answers = slide(subject, coarse, need=False)
    moved = 0.0
    for answer, size in zip(answers[1:], sizes, strict=True):
        moved += size
        if answer.dslip is not None and np.any(answer.dslip):
            break
    return straight(subject, 0.4, (0.22 * moved,) * 14, load=_LOAD, directions=directions)


class _Work:
    """Work of a path of the first point: bounds of what an integration rule may give."""

    def __init__(self, subject: Subject, case: Case) -> None:
        self.answers = slide(subject, case, need=False)
        self.stress = friction(self.answers)[..., 0]
        self.motion = motions(case)[..., 0]
        before = np.vstack([np.zeros_like(self.stress[:1]), self.stress[:-1]])
        pair = [np.sum(s * self.motion, axis=1) for s in (before, self.stress)]
        self.low, self.high = np.minimum(*pair), np.maximum(*pair)
        self.slip = _all(self.answers, "dslip")
        slips = [np.sum(s * self.slip, axis=1) for s in (before, self.stress)]
        self.slip_low, self.slip_high = np.minimum(*slips), np.maximum(*slips)
        self.sed, self.sfd = _all(self.answers, "sed"), _all(self.answers, "sfd")
        self.own = np.array([a.lm is None or a.lm[0] != 1 for a in self.answers])

    def steady(self, step: int) -> bool:
        """Whether the stress is as in the two increments before, and the motion goes on."""
        if step < 3:
            return False
        now, size = self.stress[step], np.linalg.norm(self.stress[step])
        same = np.max(np.abs(self.stress[step - 2 : step] - now)) <= 1e-9 * size
        ways = np.max(np.abs(self.motion[step - 1] - self.motion[step]))
        return bool(size > 0 and same and ways <= 1e-9 * np.linalg.norm(self.motion[step]))


def _all(answers: list[Answer], name: str) -> np.ndarray:
    return np.array([getattr(a, name)[..., 0] for a in answers])


@rule(
    "energy.elastic",
    "SED is the elastic energy: stress times recoverable slip, by halves where it is linear.",
    reference="SED is the elastic energy density at the end of the increment",
    interfaces=("fric",),
    cases=_slides,
)
def elastic(subject: Subject, case: Case) -> Finding | None:
    """Straight slides of a point that was never moved before."""
    work = _Work(subject, case)
    if not np.any(work.sed):
        raise NotApplicable("the routine never sets SED, which is optional")
    done = np.cumsum(work.high)
    least = np.cumsum(work.low)
    gone = np.cumsum(work.motion, axis=0)
    kept = np.cumsum(work.motion - work.slip, axis=0)
    straight_until = _straight(work.motion)
    for step in range(straight_until):
        if not work.own[step]:
            break
        sed, size = float(work.sed[step]), float(done[step])
        small = _ROUNDING * max(float(np.max(np.abs(done[: step + 1]))), 1e-300)
        if sed < -small:
            return _sed(step, sed, "0 or more")
        # a stiffness that changes with the strength stores more than was put in
        stored = 0.5 * float(np.linalg.norm(work.stress[step]) * np.linalg.norm(kept[step]))
        if sed > max(size, stored) + small:
            return _sed(step, sed, f"at most {number(size)}, the work done since the touch")
        slipped = np.any(work.slip[: step + 1])
        if not slipped and sed < least[step] - small:
            return _sed(step, sed, f"at least {number(float(least[step]))}, as nothing has slipped")
        half = 0.5 * float(work.stress[step] @ gone[step])
        linear = not slipped and _linear(work.stress[: step + 1], gone[: step + 1])
        if linear and abs(sed - half) > _ROUNDING * abs(half):
            return _sed(step, sed, f"{number(half)}, half of stress times elastic slip")
        if work.steady(step) and abs(sed - work.sed[step - 1]) > _ROUNDING * size:
            return _sed(
                step, sed, f"{number(float(work.sed[step - 1]))} as before: the stress is steady"
            )
    return None


def _sed(step: int, found: float, expected: str) -> Finding:
    return Finding(
        f"SED is {number(found)} in increment {step + 1}; expected {expected}",
        hint="SED is half of the stress times the elastic slip at the end of the increment, not a "
        "sum and without what has slipped",
        figures={"step": step, "point": 0},
    )


def _linear(stress: np.ndarray, gone: np.ndarray) -> bool:
    """Whether stress is proportional to the motion so far."""
    moved = np.linalg.norm(gone, axis=1)
    size = np.linalg.norm(stress, axis=1)
    if not moved[-1] or not size[-1]:
        return False
    return bool(np.all(np.abs(size - size[-1] / moved[-1] * moved) <= 1e-9 * size[-1]))


def _straight(motion: np.ndarray) -> int:
    """Number of increments at the beginning that go one way."""
    first = next((m for m in motion if np.any(m)), motion[0])
    for index, way in enumerate(motion):
        if way @ first < 0:
            return index
    return len(motion)


@rule(
    "energy.frictional",
    "SFD is the work that is lost in the increment, and with SED makes up all the work done.",
    reference="SFD is the dissipation of the increment per area: stress times DSLIP; it heats the "
    "surfaces",
    interfaces=("fric",),
    cases=_slides,
)
def frictional(subject: Subject, case: Case) -> Finding | None:
    """Each increment, and the whole path."""
    work = _Work(subject, case)
    if not np.any(work.sfd):
        if not np.any(work.stress) or not np.any(work.slip):
            return None
        raise NotApplicable("the routine never sets SFD, which is optional")
    slips = bool(np.any(work.slip))
    for step in range(len(case.steps)):
        if not work.own[step]:
            continue
        low, high = float(work.slip_low[step]), float(work.slip_high[step])
        if not slips:
            low, high = min(0.0, float(work.low[step])), max(0.0, float(work.high[step]))
            if work.steady(step):
                low = high
        found = float(work.sfd[step])
        small = _ROUNDING * max(abs(low), abs(high), 1e-300)
        if low - small <= found <= high + small:
            continue
        _counts_other_motion(subject, case)
        expected = number(high) if high - low <= small else f"{number(low)} to {number(high)}"
        return Finding(
            f"SFD is {number(found)} in increment {step + 1}; expected {expected}, stress times "
            f"{'DSLIP' if slips else 'motion'} with the stress between that at the start and that "
            "at the end",
            hint="SFD is the stress times the slip of this increment (DSLIP): neither a rate nor a "
            "sum over increments, and not negative against the slip",
            figures={"step": step, "point": 0},
        )
    return _whole(work)


def _counts_other_motion(subject: Subject, case: Case) -> None:
    """Leaves a routine alone whose SFD belongs to motion that the host does not hand over.

    Raises:
        NotApplicable: SFD is not zero at a point that has never moved.
    """
    rest = cases.history(subject, [(0.0, 0.0)] * 2, directions=case.directions, load=_LOAD)
    found = float(slide(subject, rest, need=False)[-1].sfd[0])  # type: ignore[index]
    if found:
        raise NotApplicable(
            f"SFD is {number(found)} at a point that has never moved: the routine counts motion "
            "that the host does not hand over, spin say"
        )


def _whole(work: _Work) -> Finding | None:
    """Stored and lost against done on a straight path, with room for any change of stiffness."""
    end = _straight(work.motion)
    if not np.all(work.own[:end]) or not np.any(work.sed) or not np.any(work.slip):
        return None
    recovered = np.cumsum(work.motion - work.slip, axis=0)[:end]
    peak = float(np.max(np.linalg.norm(work.stress[:end], axis=1)))
    wide = peak * float(np.max(np.linalg.norm(recovered, axis=1)))
    found = float(work.sed[end - 1] + np.sum(work.sfd[:end]))
    low, high = (float(np.sum(w[:end])) for w in (work.low, work.high))
    small = wide + _ROUNDING * max(abs(low), abs(high))
    if low - small <= found <= high + small or math.isnan(found):
        return None
    return Finding(
        f"SED and the sum of SFD make {number(found)} after increment {end}; expected "
        f"{number(low)} to {number(high)}, the work of the stress",
        hint="what the stress does is stored (SED) or lost (SFD): DSLIP is the motion less the "
        "change of elastic slip",
        figures={"step": end - 1, "point": 0},
    )
