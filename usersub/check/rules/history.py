# SPDX-License-Identifier: MIT
"""A history may be interrupted: thrown away increments, more iterations and restarts leave no
trace."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.probing.elsewhere import FreshProcess
from usersub.check.respond import run_of
from usersub.check.respond.answer import Answer
from usersub.check.rule import STANDARD, CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.words import failed, first_unlike, told_apart
from usersub.check.subject import Subject
from usersub.errors import Error

#: A routine may begin its own iteration where the last one ended: that moves results by rounding.
_ITERATION_TOLERANCE = 1e-9

_STATE = (
    "what lasts has to be in the state variables, and these have to be computed from their values "
    "at the start of the increment"
)


def _histories(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject):
        yield from cases.plain(subject, directions)


@rule(
    "history.cut-back",
    "An increment that is thrown away and tried again in two halves leaves no trace.",
    reference="an implicit host cuts back: every attempt starts from the state of the last commit",
    interfaces=STANDARD,
    cases=_histories,
)
def cut_back(subject: Subject, case: Case) -> Finding | None:
    """The history in halves, with and without an attempt at the whole increment before."""
    halves: list[Step] = []
    tried: list[Step] = []
    for step in case.steps:
        half = replace(step, motion=_scaled(step.motion, 0.5), dt=0.5 * step.dt)
        halves += [half, half]
        tried += [replace(step, cut_back=True), half, half]
    straight = _answers(subject, case.but(steps=tuple(halves)))
    after = subject.respond(case.but(steps=tuple(tried)), enforced=1)
    kept = [a for k, a in enumerate(after) if k % 3]
    told = _told("after an increment that was thrown away", straight, kept)
    return told or _failed_after("after an increment that was thrown away", after)


@rule(
    "history.iterations",
    "How many iterations an increment takes changes nothing.",
    reference="state variables and TAU on entry are those at the start of the increment in every "
    "iteration",
    interfaces=STANDARD,
    cases=_histories,
)
def iterations(subject: Subject, case: Case) -> Finding | None:
    """One iteration against three, with other motions in the first two."""
    once = _answers(subject, case)
    thrice = case.but(steps=tuple(replace(s, iterations=3) for s in case.steps))
    more = subject.respond(thrice, enforced=1)
    if any(a.lm is not None and (a.lm == 1).any() for a in (*once, *more)):
        raise NotApplicable("LM = 1: the host solves for the constraint over the iterations")
    if _close(once, more):
        return None
    found = _told("after three iterations", once, more) or _failed_after(
        "in the second or third iteration", more
    )
    return None if found is None else replace(found, hint=_iteration_hint(subject))


def _iteration_hint(subject: Subject) -> str:
    """What carries something from one iteration to the next besides variables that are kept."""
    if subject.interface.name != "fric":
        return _STATE
    last = (
        "DSLIP and LM hold on entry what the routine returned in the last iteration: friction must "
        "not depend on them, nor on what is kept from call to call (SAVE, COMMON)"
    )
    return f"{last}; {_STATE}" if subject.states else last


@rule(
    "history.save-load",
    "Saving the state and going on in another process changes nothing.",
    reference="a restart keeps the state variables and what the host keeps, nothing else",
    cases=_histories,
)
def save_load(subject: Subject, case: Case) -> Finding | None:
    """The history at one go, and its second half in a process that has not run the first."""
    middle = len(case.steps) // 2

    def go_on(saved: bytes) -> list[Answer] | str:
        quiet = subject.but(tell=None)
        try:
            run = run_of(quiet, case, enforced=True)
            run.load(saved, middle)
            return [run.step(k) for k in range(middle, len(case.steps))]
        except Error as error:
            return str(error)

    with FreshProcess(go_on) as fresh:
        run = run_of(subject, case, enforced=True)
        try:
            for k in range(middle):
                run.step(k)
            saved = run.driver.state.save()
            straight = [run.step(k) for k in range(middle, len(case.steps))]
        except Error as error:
            raise CannotCheck(f"the routine failed: {error}") from error
        loaded = fresh.finish(saved)
    if loaded is None:
        return Finding("the routine crashed after a restart", hint=_STATE)
    if isinstance(loaded, str):
        return Finding(f"after a restart the routine failed: {loaded}", hint=_STATE)
    return _told("after a restart", straight, loaded, middle)


def _scaled(motion: tuple, factor: float) -> tuple:
    return tuple(tuple(factor * c for c in m) for m in motion)


def _answers(subject: Subject, case: Case) -> list[Answer]:
    answers = subject.respond(case, enforced=1)
    if failed(answers):
        raise CannotCheck(f"the routine failed: {failed(answers)}")
    return answers


def _failed_after(how: str, answers: list[Answer]) -> Finding | None:
    if failed(answers):
        return Finding(f"{how} the routine failed: {failed(answers)}", hint=_STATE)
    return None


def _close(ones: list[Answer], others: list[Answer]) -> bool:
    """Whether all arrays agree but for the rounding of a routine's own iteration."""
    if len(ones) != len(others) or failed(others):
        return False
    for one, other in zip(ones, others, strict=True):
        for name, array in one.arrays().items():
            twin = getattr(other, name)
            size = float(np.abs(array).max(initial=0.0))
            if not np.allclose(array, twin, rtol=0.0, atol=_ITERATION_TOLERANCE * size):
                return False
    return True


def _told(
    how: str, ones: list[Answer], others: list[Answer], first_step: int = 0
) -> Finding | None:
    found = first_unlike(ones, others)
    if found is None:
        return None
    step, name, point = found
    one, other = told_apart(ones[step], others[step], name, point)
    step += first_step
    detail = f"{how} {name} of point {point + 1} in increment {step + 1} is {other}, expected {one}"
    return Finding(detail, hint=_STATE, figures={"step": step, "point": point})
