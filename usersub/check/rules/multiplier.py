# SPDX-License-Identifier: MIT
"""What FRIC tells the host: LM, the state of the point, and PNEWDT, the wish for a smaller step."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.probing.response_of import pulled
from usersub.check.respond import run_of
from usersub.check.rule import CannotCheck, Finding, rule
from usersub.check.rules.figures import number, values
from usersub.check.subject import Subject
from usersub.driver.status import VALUES
from usersub.errors import Error

#: Iterations of an increment after which LM has to have settled.
_ITERATIONS = 12
#: Motions over the slip scale of increments in which a routine may ask for a smaller one.
_FAR = (1e3, 1e7)
#: Multiplier over the friction in slip that no critical stress explains.
_ABOVE = 100.0


def _histories(subject: Subject) -> Iterator[Case]:
    for directions in (1, 2):
        made = cases.slipping(subject, 1, directions)
        yield made
        yield cases.sticking(subject, 1, directions)
        yield cases.changing_load(subject, 1, directions)
        yield pulled(subject, made)


@rule(
    "multiplier.protocol",
    "LM is 0, 1 or 2, settles within an increment, and a released point has stress along the pull.",
    reference="LM = 0 slip or elastic stick, 1 sticking by Lagrange multipliers, 2 no friction; in "
    "later iterations LM is what the routine returned in the one before",
    interfaces=("fric",),
    cases=_histories,
)
def protocol(subject: Subject, case: Case) -> Finding | None:
    """Iterates every increment until LM should have settled."""
    subject.under_way(case)
    run = run_of(subject, case)
    had_friction, strongest, stuck = False, 0.0, np.zeros(case.points, dtype=bool)
    before = np.zeros((case.directions, case.points))
    for index, step in enumerate(case.steps):
        seen: list[np.ndarray] = []
        last = None
        for iterations in range(1, _ITERATIONS + 1):
            run.case = _until(case, index, iterations, final=iterations == _ITERATIONS)
            try:
                last = run.step(index)
            except Error as error:
                return _failed(error, index)
            assert last.lm is not None
            seen.append(last.lm)
        assert last is not None and last.lm is not None and last.friction is not None
        for point in range(case.points):
            path = [int(lm[point]) for lm in seen]
            figures = {"step": index, "point": point}
            goes_on = _goes_on(before[:, point], np.array(step.motion[point]))
            if len({*path[-4:]}) > 1 and goes_on:
                return Finding(
                    f"LM of increment {index + 1} goes {', '.join(map(str, path))} over the "
                    "iterations with the same motion; expected it to settle",
                    hint="decide between stick and slip from the multiplier (TAULM) while LM is 1 "
                    "on entry, and from motion and stress while it is 0, not by turns",
                    figures=figures,
                )
            if path[-1] == 2 and had_friction and step.load[point] > 0 and _moves(step, point):
                return Finding(
                    f"LM is 2 in increment {index + 1} at pressure {number(step.load[point])}, "
                    "where the point had friction in the increment before; expected 0 or 1",
                    hint="return LM = 2 only where the point was open at the start (LM = 2 on "
                    "entry) or is to have no friction at all",
                    figures=figures,
                )
            if path[-1] == 0 and (1 in path or stuck[point]):
                found = _released(last.friction[:, point], step, point, index)
                if found is not None:
                    return found
            if path[-1] == 1 and strongest > 0:
                found = _never_let_go(step, point, index, strongest)
                if found is not None:
                    return found
        stuck, before = last.lm == 1, last.friction
        had_friction = bool(np.all(last.lm != 2))
        own = last.friction[:, last.lm == 0]
        strongest = max(strongest, float(np.max(np.linalg.norm(own, axis=0), initial=0.0)))
    return None


def _until(case: Case, index: int, iterations: int, *, final: bool) -> Case:
    """The case whose step `index` has so many iterations, and is thrown away unless `final`."""
    changed = replace(case.steps[index], iterations=iterations, cut_back=not final)
    return case.but(steps=(*case.steps[:index], changed, *case.steps[index + 1 :]))


def _goes_on(stress: np.ndarray, motion: np.ndarray) -> bool:
    """Whether the point moves, and not against its stress: then nothing lets it stick again.

    Without motion, or against the stress, a point that slips may stick at once; the host would then
    have other motions in the next iteration.
    """
    return bool(np.any(motion)) and float(stress @ motion) >= 0


def _moves(step: Step, point: int) -> bool:
    return any(step.motion[point])


def _failed(error: Error, index: int) -> Finding | None:
    text = str(error)
    if error.status == VALUES["CONTRACT"] and "LM =" in text:
        return Finding(
            f"in increment {index + 1} {_own(text)}",
            hint="set LM to 0 (slip or elastic stick), 1 (no slip) or 2 (no friction)",
            figures={"step": index, "point": error.point or 0},  # type: ignore[attr-defined]
        )
    raise CannotCheck(f"the routine failed in increment {index + 1}: {text}")


def _own(text: str) -> str:
    return text.removeprefix("FRIC: ")


def _never_let_go(step: Step, point: int, index: int, strongest: float) -> Finding | None:
    """A point that had slipped before still sticks under a multiplier above all that it bore."""
    pull = step.multiplier[point] if step.multiplier is not None else (0.0,)
    if float(np.linalg.norm(pull)) < _ABOVE * strongest:
        return None
    return Finding(
        f"LM stays 1 in increment {index + 1} under the multiplier (TAULM) {values(pull)}, where "
        f"friction had the size {number(strongest)} when it slipped; expected the point to be "
        "released, LM = 0",
        hint="while LM is 1 on entry, compare the size of TAULM with the critical stress and "
        "return LM = 0 where it is above",
        figures={"step": index, "point": point},
    )


def _released(stress: np.ndarray, step: Step, point: int, index: int) -> Finding | None:
    """A point that slips after it stuck: stress along the multiplier, and not more of it."""
    if step.multiplier is None or not any(step.multiplier[point]):
        return None
    pull = np.array(step.multiplier[point])
    size, most = float(np.linalg.norm(stress)), float(np.linalg.norm(pull))
    if float(stress @ pull) >= -1e-9 * size * most and size <= most * (1.0 + 1e-6):
        return None
    return Finding(
        f"a point that is released in increment {index + 1} has TAU = {values(stress)} under the "
        f"multiplier {values(pull)}; expected stress along it and not above it",
        hint="let a released point slip along the multiplier (TAULM), with the critical stress",
        figures={"step": index, "point": point},
    )


def _far(subject: Subject) -> Iterator[Case]:
    yield from _histories(subject)
    for factor in _FAR:
        unit = factor * subject.scales.slip
        yield cases.history(subject, [(1.0, 0.0)] * 2, unit=unit)


@rule(
    "pnewdt.positive",
    "PNEWDT is above zero.",
    reference="the host multiplies the time increment by it",
    interfaces=("fric",),
    cases=_far,
)
def pnewdt(subject: Subject, case: Case) -> Finding | None:
    """Slip, stick, changing load; motions so large that a routine asks for a smaller step."""
    answers = subject.respond(case)
    index, failure = len(answers) - 1, answers[-1].failure
    for step, answer in enumerate(answers):
        value = answer.pnewdt
        if value is not None and not value > 0:
            return _not_positive(f"PNEWDT is {number(value)} in increment {step + 1}", step)
    if failure is None:
        return None
    text = str(failure)
    if failure.status == VALUES["NOT_FINITE"]:
        return None  # of motions as large as these; extremes.finite says more
    if failure.status == VALUES["CONTRACT"] and "PNEWDT" in text:
        return _not_positive(f"in increment {index + 1} {_own(text).partition(';')[0]}", index)
    raise CannotCheck(f"the routine failed in increment {index + 1}: {text}")


def _not_positive(what: str, step: int) -> Finding:
    return Finding(
        f"{what}; expected a value above 0",
        hint="leave PNEWDT alone, or set it below 1 (0.5, say) to ask for a smaller increment",
        figures={"step": step, "point": 0},
    )
