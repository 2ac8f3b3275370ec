# SPDX-License-Identifier: MIT
"""A routine keeps nothing of its own: the same inputs give the same outputs, whenever and wherever
it is called."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.elsewhere import FreshProcess
from usersub.check.respond.answer import Answer
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.words import failed, first_unlike, told_apart
from usersub.check.source import statics, unset
from usersub.check.subject import Subject

HINT = (
    "keep what has to last from call to call in state variables, nothing in SAVE, COMMON or static "
    "data"
)


def _repeated(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject):
        yield from cases.plain(subject, directions)
        if subject.interface.solver == "explicit":
            made = cases.slipping(subject, 1, directions)
            yield made.but(steps=made.steps[1:])  # at once, with what a routine may have kept


@rule(
    "repeat.same",
    "The same inputs twice give the same outputs.",
    reference="an implicit host calls again in every iteration; state variables and arguments are "
    "all that a routine may depend on",
    cases=_repeated,
)
def same(subject: Subject, case: Case) -> Finding | None:
    """Runs the case twice, from the start, in the same process."""
    first = _answers(subject, case)
    second = subject.respond(case)
    return _explained(subject, told("run a second time,", first, second))


@rule(
    "repeat.order",
    "Calls for other contact points or another interaction before change nothing.",
    reference="a host calls for all points and all interactions, in an order of its own",
    cases=_repeated,
)
def order(subject: Subject, case: Case) -> Finding | None:
    """Runs the case first, and in another process after calls for something else."""
    quiet = subject.but(tell=None)

    def run(before: Case | None) -> list[Answer]:
        if before is not None:
            quiet.respond(before)
        return quiet.respond(case)

    others = _others(subject, case)
    with ExitStack() as stack:  # all made before the routine is called for the first time
        fresh = [stack.enter_context(FreshProcess(run)) for _ in range(len(others) + 1)]
        first = fresh[0].finish(None)
        if first is None:
            raise CannotCheck("the routine ended its process")
        if failed(first):
            raise CannotCheck(f"the routine failed: {failed(first)}")
        for process, (what, other) in zip(fresh[1:], others.items(), strict=True):
            after = process.finish(other)
            found = None if after is None else told(f"after {what}", first, after)
            if found is not None:
                return _explained(subject, found)
    return None


def _explained(subject: Subject, found: Finding | None) -> Finding | None:
    """The finding with the hint that fits a routine that has no data of its own, too."""
    if found is None:
        return None
    try:
        if statics.of_routine(subject):
            return found
    except (CannotCheck, NotApplicable):
        return found
    warned = unset.warned(subject)
    if not warned:
        return found  # a file, or an array of the solver's, may be what lasts
    hint = (
        "it has no data that outlive a call: set every local variable before it is used; the "
        f"compiler names {unset.named(warned)}"
    )
    return replace(found, hint=hint, where=found.where or warned[0].where)


def _others(subject: Subject, case: Case) -> dict[str, Case]:
    """What may be called before, in words."""
    heavier = tuple(replace(s, load=tuple(3.0 * p for p in s.load)) for s in case.steps)
    warm = ((subject.scales.temperature + 40.0,) * 2,) * case.points
    warmer = tuple(replace(s, temperature=warm) for s in heavier)
    found = {"calls for another point with three times the load": case.but(steps=heavier)}
    if subject.temperatures:
        found["calls for a warmer point"] = case.but(steps=warmer)
    if subject.props:
        other = case.but(props=tuple(1.5 * p for p in subject.props))
        found["calls of another interaction with 1.5 times the properties"] = other
    return found


def _answers(subject: Subject, case: Case) -> list[Answer]:
    answers = subject.respond(case)
    if failed(answers):
        raise CannotCheck(f"the routine failed: {failed(answers)}")
    return answers


def told(how: str, ones: list[Answer], others: list[Answer]) -> Finding | None:
    """What differs between two runs, said after `how`, or None."""
    if failed(others):
        return Finding(f"{how} the routine failed: {failed(others)}", hint=HINT)
    found = first_unlike(ones, others)
    if found is None:
        return None
    step, name, point = found
    one, other = told_apart(ones[step], others[step], name, point)
    place = f"{name} of point {point + 1} in increment {step + 1}"
    detail = f"{how} {place} is {other}; expected {one} as before"
    return Finding(detail, hint=HINT, figures={"step": step, "point": point})
