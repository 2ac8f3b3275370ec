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
from usersub.check.rules.words import first_unlike, told_apart
from usersub.check.subject import Subject

#: Field and state variables beyond those that the routine reads.
_MORE = 2
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
    for seen, words, straight in _with_more(subject, case):
        n = case.points
        for order in (tuple(reversed(range(n))), (*range(1, n), 0)):
            found = _unlike(straight, seen.respond(case.but(order=order)))
            if found:
                detail = f"{words}in the order {_counted(order)} of the points {found}"
                return Finding(detail, hint=indices.own_point(subject, "field var" in words))
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
    for seen, words, whole in _with_more(subject, case):
        for size in range(1, min(case.points, 4)):
            found = _unlike(whole, seen.respond(case, block=size))
            if found:
                detail = f"{words}in blocks of {size} instead of {case.points} points {found}"
                return Finding(detail, hint=indices.own_point(subject, "field var" in words))
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


def _with_more(subject: Subject, case: Case) -> Iterator[tuple[Subject, str, list[Answer]]]:
    """The subject, then with more field and more state variables than it reads, as a model may
    have; what to say of that, and the answers to the case.

    With one of them, exchanged subscripts (fieldSec(k,1) for fieldSec(1,k)) are the same element.
    """
    yield subject, "", _answers(subject, case)
    for name, words in (("fields", "field"), ("states", "state")):
        count = getattr(subject, name)
        if not count or case.state is not None:
            continue
        more = subject.but(**{name: count + _MORE})
        given = more.scales.fields
        if name == "fields" and given:
            grown = (*given, *(given[-1] + 0.25 * k for k in range(1, _MORE + 1)))
            more = more.but(scales=replace(more.scales, fields=grown))
        answers = more.respond(case)
        if answers[-1].failure is None:  # it may want exactly as many as it reads
            yield more, f"with {count + _MORE} {words} variables, ", answers


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
    one, other = told_apart(ones[step], others[step], name, point)
    return f"{name} of point {point + 1} in increment {step + 1} is {other}, expected {one}"


def _counted(order: tuple[int, ...]) -> str:
    return ", ".join(str(p + 1) for p in order)
