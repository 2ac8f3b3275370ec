# SPDX-License-Identifier: MIT
"""Rules: one requirement each, with an identifier, a reference and what it applies to."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from usersub import abi

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject

#: Weight of a failure: an "error" is a broken contract, a "warning" is to be looked at, a "note"
#: only tells.
SEVERITIES = ("error", "warning", "note")

PASS, FAIL, SKIP, NOT_APPLICABLE = "pass", "fail", "skip", "not-applicable"

STANDARD = ("fric", "fric_coef")
EXPLICIT = ("vfric", "vfriction", "vfric_coef")
#: Interfaces that give a stress or a force, and those that give a coefficient.
FRICTION = ("fric", "vfric", "vfriction")
COEFFICIENT = ("fric_coef", "vfric_coef")


class NotApplicable(Exception):  # noqa: N818 - an answer, not an error
    """The rule says nothing of this subject; the message says why."""


class CannotCheck(Exception):  # noqa: N818
    """The rule applies, but could not be checked; the message says why."""


@dataclass(frozen=True)
class Finding:
    """What a rule found.

    Attributes:
        detail: one sentence that names the thing, its value and what was expected.
        case: the case that shows it; None where no call is needed to see it.
        where: "file:line" in the routine's source, or "".
        hint: what to change, in one sentence, or "".
        figures: numbers for the report, by name (arrays as lists).
    """

    detail: str
    case: Case | None = None
    where: str = ""
    hint: str = ""
    figures: dict[str, Any] = field(default_factory=dict)


#: What a judge says of a case: nothing, a sentence, or a whole finding.
Judgement = str | Finding | None
Judge = Callable[["Subject", "Case"], Judgement]


@dataclass(frozen=True)
class Rule:
    """One requirement.

    Attributes:
        id: "group.name".
        requirement: what has to hold, one sentence.
        reference: where that stands, in words.
        severity: one of `SEVERITIES`.
        interfaces: names of the interfaces that it is about.
        languages: languages that it is about; () for all.
        look: gives findings, none if the rule holds.
        judge: says of one case whether it breaks the rule; None where there are no cases. With it a
            failing case is made smaller and can be run again alone.
        seconds: time limit of the rule.
    """

    id: str
    requirement: str
    reference: str
    severity: str
    interfaces: tuple[str, ...]
    languages: tuple[str, ...]
    look: Callable[[Subject], Iterable[Finding] | None] = field(repr=False)
    judge: Judge | None = field(default=None, repr=False)
    seconds: float = 10.0

    @property
    def group(self) -> str:
        """The part of the identifier before the point."""
        return self.id.partition(".")[0]


#: Every rule for routines by identifier, in the order in which they run.
RULES: dict[str, Rule] = {}


def rule(
    id: str,
    requirement: str,
    *,
    reference: str,
    severity: str = "error",
    interfaces: tuple[str, ...] = abi.NAMES,
    languages: tuple[str, ...] = (),
    cases: Callable[[Subject], Iterable[Case]] | None = None,
    seconds: float = 10.0,
) -> Callable[[Callable], Callable]:
    """Makes a rule of a function.

    Without `cases` the function takes the subject and yields findings (or returns None). With them
    it is a judge: it takes the subject and a case and returns None, a sentence or a `Finding`; the
    rule fails at the first case with a judgement.
    """
    if severity not in SEVERITIES:
        raise ValueError(f"severity is '{severity}', expected one of {', '.join(SEVERITIES)}")

    def register(function: Callable) -> Callable:
        look = function if cases is None else _first_of(function, cases)
        judge = None if cases is None else function
        made = Rule(
            id, requirement, reference, severity, interfaces, languages, look, judge, seconds
        )
        if id in RULES and RULES[id].look.__module__ != look.__module__:
            raise ValueError(f"rule '{id}' exists already")
        RULES[id] = made
        return function

    return register


def as_finding(judgement: Judgement, case: Case) -> Finding | None:
    """A judgement as a finding that knows its case."""
    if judgement is None:
        return None
    if isinstance(judgement, str):
        return Finding(judgement, case)
    if judgement.case is None:
        return Finding(
            judgement.detail, case, judgement.where, judgement.hint, dict(judgement.figures)
        )
    return judgement


def _first_of(judge: Judge, cases: Callable[[Subject], Iterable[Case]]) -> Callable:
    def look(subject: Subject) -> Iterator[Finding]:
        for case in cases(subject):
            subject.under_way(case)
            found = as_finding(judge(subject, case), case)
            if found is not None:
                yield found
                return

    look.__module__ = judge.__module__
    return look
