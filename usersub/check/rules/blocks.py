# SPDX-License-Identifier: MIT
"""Contact points do not know of each other: their place in the block changes no bit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.respond.answer import Answer
from usersub.check.rule import EXPLICIT, CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules import indices
from usersub.check.rules.words import first_unlike, value_at
from usersub.check.subject import Subject

_REFERENCE = "every point of a call has its own arguments; how many share a call is the host's"


def _blocks(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject):
        yield cases.slipping(subject, 2, directions)
        yield cases.slipping(subject, cases.MANY, directions)
        yield cases.changing_load(subject, cases.MANY, directions)
        if subject.interface.name != "vfric_coef":
            yield cases.held(subject, cases.MANY, directions)
    for contact in cases.contacts(subject)[1:]:
        yield cases.slipping(subject, cases.MANY).but(contact=contact)


@rule(
    "blocks.permute",
    "The order of the contact points in a block changes nothing.",
    reference=_REFERENCE,
    interfaces=EXPLICIT,
    cases=_blocks,
)
def permute(subject: Subject, case: Case) -> Finding | None:
    """Other orders of the points, same bits."""
    straight = _answers(subject, case)
    n = case.points
    for order in (tuple(reversed(range(n))), (*range(1, n), 0)):
        shuffled = subject.respond(case.but(order=order))
        found = _unlike(straight, shuffled)
        if found:
            detail = f"in the order {_counted(order)} of the points {found}"
            return Finding(detail, hint=indices.own_point(subject))
    return None


@rule(
    "blocks.split",
    "How the contact points are cut into blocks changes nothing.",
    reference=_REFERENCE,
    interfaces=EXPLICIT,
    cases=_blocks,
)
def split(subject: Subject, case: Case) -> Finding | None:
    """Other block sizes, same bits."""
    whole = _answers(subject, case)
    for size in range(1, min(case.points, 4)):
        found = _unlike(whole, subject.respond(case, block=size))
        if found:
            detail = f"in blocks of {size} instead of {case.points} points {found}"
            return Finding(detail, hint=indices.own_point(subject))
    return None


@rule(
    "blocks.coefficient",
    "FRIC_COEF sets every point of the block that it is given.",
    reference="fCoef has nBlock entries; published routines often set the first only, and are "
    "called with one point",
    interfaces=("fric_coef",),
    severity="note",
)
def many_points(subject: Subject) -> Iterator[Finding]:
    """FRIC_COEF with several points a call, same bits as one by one."""
    assert subject.routine is not None
    if subject.states:
        raise NotApplicable("with state variables it is called with one point")
    several = subject.but(routine=replace(subject.routine, block_safe=True))
    for case in (cases.slipping(subject, 3, 1), cases.slipping(subject, 3)):
        single = _answers(subject, case)
        found = _unlike(single, several.respond(case))
        if found:
            hint = "loop over nBlock; until then the drivers call it with one point"
            yield Finding(f"with three points a call {found}", case, hint=hint)
            return


def _answers(subject: Subject, case: Case) -> list[Answer]:
    answers = subject.respond(case)
    if answers[-1].failure is not None:
        raise CannotCheck(f"the routine failed: {answers[-1].failure}")
    return answers


def _unlike(ones: list[Answer], others: list[Answer]) -> str:
    """What differs, in words, or ""."""
    if others[-1].failure is not None:
        return f"the routine failed: {others[-1].failure}"
    found = first_unlike(ones, others)
    if found is None:
        return ""
    step, name, point = found
    one, other = value_at(ones[step], name, point), value_at(others[step], name, point)
    return f"{name} of point {point + 1} in step {step + 1} is {other}, expected {one}"


def _counted(order: tuple[int, ...]) -> str:
    return ", ".join(str(p + 1) for p in order)
