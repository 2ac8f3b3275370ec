# SPDX-License-Identifier: MIT
"""No pressure, no friction: what happens at and below zero."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.probing.response_of import friction, motions, slide, tolerance
from usersub.check.rule import COEFFICIENT, Finding, NotApplicable, rule
from usersub.check.rules.figures import number, values
from usersub.check.rules.zero import finite
from usersub.check.subject import Subject

_WAY = (0.8, 0.6)
#: Loads over the load scale from which friction without pressure is guessed.
_LITTLE = (1e-6, 1e-9)


def _without(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        yield _under(subject, 0.0, directions)
        yield _unloaded(subject, 0.0, directions)


def _under(subject: Subject, load: float, directions: int) -> Case:
    """A slide that begins with the load."""
    return cases.history(subject, [_WAY] * 2, load=load, directions=directions)


def _unloaded(subject: Subject, load: float, directions: int) -> Case:
    """A slide in which the load falls."""
    made = cases.history(subject, [_WAY] * 4, directions=directions)
    low = tuple(load * subject.scales.load for _ in range(made.points))
    last = replace(made.steps[-1], load=low)
    return made.but(steps=(*made.steps[:-1], last))


@rule(
    "pressure.zero",
    "At zero pressure there is no friction, but for adhesion that is there at little pressure too.",
    reference="the critical stress is the coefficient times the pressure; a law with cohesion has "
    "a strength at zero pressure",
    cases=_without,
)
def zero(subject: Subject, case: Case) -> Finding | None:
    """The last increment has no pressure."""
    name = "normal force" if subject.interface.solver == "explicit" else "pressure"
    found = finite(subject, case, f"at {name} 0", name, lambda s: not any(s.load))
    if found is not None or subject.interface.name in COEFFICIENT:
        return found
    last = _last(subject, case)
    if last is None:
        return None
    near = [_last(subject, _with_last_load(subject, case, load)) for load in _LITTLE]
    largest = max(float(np.linalg.norm(n)) for n in near if n is not None)
    size = float(np.linalg.norm(last))
    loaded = _last(subject, _with_last_load(subject, case, 1.0))
    usual = largest if loaded is None else float(np.linalg.norm(loaded))
    if largest > 1.05 * usual + tolerance(subject) * subject.scales.load:
        return Finding(
            f"friction is {number(largest)} at {name} {number(_LITTLE[-1] * subject.scales.load)} "
            f"or {number(_LITTLE[0] * subject.scales.load)} and {number(usual)} at "
            f"{number(subject.scales.load)}; expected it not to grow as the {name} falls to 0",
            hint=f"multiply by the {name}, do not divide by it",
            figures={"step": len(case.steps) - 1, "point": 0},
        )
    if size <= tolerance(subject) * subject.scales.load:
        return None
    if size <= largest * (1.0 + 1e-3):
        return None  # adhesion, or friction that depends on no pressure
    return Finding(
        f"{_symbol(subject)} = {values(last)} at {name} 0; expected at most {number(largest)}, "
        f"the friction at {name} {number(_LITTLE[-1] * subject.scales.load)}",
        hint=f"no {name}, no friction: return 0 where the {name} is not above zero",
        figures={"step": len(case.steps) - 1, "point": 0},
    )


def _negative(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        for load in (-1.0, -100.0):
            yield _under(subject, load, directions)
        yield _unloaded(subject, -1.0, directions)


@rule(
    "pressure.negative",
    "At a negative pressure there is no more friction than at zero pressure.",
    reference="FRIC is called for points that are overclosed or were closed before, whatever their "
    "pressure",
    interfaces=("fric",),
    cases=_negative,
)
def negative(subject: Subject, case: Case) -> Finding | None:
    """Compares with the same slide at zero pressure."""
    load = case.steps[-1].load[0]
    found = finite(subject, case, f"at pressure {number(load)}", "pressure", _below_zero)
    if found is not None or load >= 0:
        return found
    last, base = _last(subject, case), _last(subject, _with_last_load(subject, case, 0.0))
    if last is None or base is None:
        raise NotApplicable("the host finds the stress (LM = 1), or there is none (LM = 2)")
    allowed, size = float(np.linalg.norm(base)), float(np.linalg.norm(last))
    small = tolerance(subject) * subject.scales.load
    if size > allowed * (1.0 + 1e-6) + small:
        what = "the friction at zero pressure" if allowed else "no friction"
        return _finding(
            case,
            f"{values(last)} at pressure {number(load)}; expected at most "
            f"{number(allowed)}, {what}",
        )
    if float(last @ motions(case)[-1, :, 0]) < -small * np.linalg.norm(motions(case)[-1]):
        return _finding(
            case,
            f"{values(last)} against the motion {values(case.steps[-1].motion[0])}"
            f" at pressure {number(load)}; expected none, or one along the motion",
        )
    return None


def _below_zero(step: Step) -> bool:
    return any(p < 0 for p in step.load)


def _finding(case: Case, what: str) -> Finding:
    return Finding(
        f"tau = {what}",
        hint="take max(PRESS, 0) as the pressure, not PRESS or its absolute value",
        figures={"step": len(case.steps) - 1, "point": 0},
    )


def _symbol(subject: Subject) -> str:
    return "tau" if subject.interface.name == "fric" else "friction force"


def _with_last_load(subject: Subject, case: Case, load: float) -> Case:
    """The case in which the loads that are not positive are `load` (in load scales)."""
    value = load * subject.scales.load
    steps = tuple(
        replace(s, load=tuple(value if p <= 0 else p for p in s.load)) for s in case.steps
    )
    return case.but(steps=steps)


def _last(subject: Subject, case: Case) -> np.ndarray | None:
    """Friction of the last increment; None where it is not the routine's."""
    answers = slide(subject, case, need=False)
    if answers[-1].lm is not None and np.any(answers[-1].lm == 1):
        return None
    return friction(answers)[-1, :, 0]
