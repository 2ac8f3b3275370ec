# SPDX-License-Identifier: MIT
"""What a child process does with a rule: look, say what was found, and make the case smaller."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from usersub.check.rule import (
    FAIL,
    NOT_APPLICABLE,
    PASS,
    SKIP,
    CannotCheck,
    Finding,
    NotApplicable,
    Rule,
    as_finding,
)
from usersub.check.running.verdicts import finding_as_data
from usersub.check.words import around_in_words
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.running.inside import Channel
    from usersub.check.subject import Subject

#: Groups and rules for which names and step numbers make no difference, or are no reason to judge.
_ANYWHERE = (
    "signature",
    "symbols",
    "data",
    "friction",
    "law",
    "precision.source",
    "process.output",
)
#: Share of a rule's time after which it is not looked at under further names.
_SHARE = 0.1


def look(rule: Rule, subject: Subject, child: Channel) -> None:
    """Looks at a rule, says the first finding, then the same at smaller and smaller cases."""
    subject = subject.but(tell=child.tell)
    begin = time.monotonic()
    verdict = _look_at(rule, subject, child)
    once = rule.group in _ANYWHERE or rule.id in _ANYWHERE
    for around in () if once else subject.others:
        if verdict == FAIL or time.monotonic() - begin > _SHARE * rule.seconds:
            return
        if rule.id == "history.cut-back" and len(set(around.step_numbers)) > 1:
            continue  # half an increment would be in another step than the whole
        there = _look_at(rule, subject.but(around=around), child, quiet=True)
        if there == PASS and verdict != PASS:
            child.say({"verdict": {"kind": PASS, "detail": ""}})
        verdict = there if there in (PASS, FAIL) else verdict


def _look_at(rule: Rule, subject: Subject, child: Channel, quiet: bool = False) -> str:
    """Looks at a rule at one place; the verdict. If `quiet`, only a finding is said."""
    finding, verdict = _say(
        lambda: next(iter(rule.look(subject) or ()), None), child, subject, quiet
    )
    if finding is None or finding.case is None or rule.judge is None:
        return verdict
    from usersub.check.running.shrink import smaller

    for found in smaller(rule, subject, finding):
        child.say({"finding": finding_as_data(_placed(found, subject))})
    return verdict


def _placed(finding: Finding, subject: Subject) -> Finding:
    """A finding with the names and step numbers at which it was made, if not the ordinary ones."""
    parts = around_in_words(subject.around.names, subject.around.step_numbers)
    if not parts:
        return finding
    case = None if finding.case is None else subject.placed(finding.case)
    return replace(finding, detail=f"with {', '.join(parts)}: {finding.detail}", case=case)


def look_at_all(
    rules: Sequence[Rule],
    limits: Sequence[float],
    until: float,
    subject: Subject,
    child: Channel,
) -> None:
    """Looks at rules one after the other, each in a stage of its own, up to a time of the clock
    that does not jump."""
    for rule, seconds in zip(rules, limits, strict=True):
        left = until - time.monotonic()
        if left < 0.0:
            return
        child.stage(rule.id, min(seconds, max(left, 1.0)))
        try:
            look(rule, subject, child)
        except BaseException as error:
            child.fail(error)


def look_at_case(
    rule: Rule, subject: Subject, case: Case | None, child: Channel | None
) -> Finding | None:
    """Looks at one case of a rule; at the whole rule where it is not about single cases.

    Without a child to say it to, what the rule raises is raised.
    """

    def found() -> Finding | None:
        if case is None or rule.judge is None:
            return next(iter(rule.look(told) or ()), None)
        told.under_way(case)
        return as_finding(rule.judge(told, case), case)

    told = subject if case is None else subject.at(case)
    if child is None:
        return found()
    told = told.but(tell=child.tell)
    return _say(found, child, told)[0]


def run_case(subject: Subject, case: Case, child: Channel) -> None:
    """Runs a case through the driver; what it gives does not matter."""
    subject.but(tell=child.tell).respond(case)


def _say(
    find: Callable[[], Finding | None], child: Channel, subject: Subject, quiet: bool = False
) -> tuple[Finding | None, str]:
    """Says what is found, and the verdict; if `quiet`, only what is found."""
    try:
        finding = find()
    except NotApplicable as reason:
        if not quiet:
            child.say({"verdict": {"kind": NOT_APPLICABLE, "detail": str(reason)}})
        return None, NOT_APPLICABLE
    except (CannotCheck, Error) as error:
        plain = isinstance(error, CannotCheck)
        words = str(error) if plain else f"it could not be checked: {error}"
        if not quiet:
            _say_skip(" ".join(words.split()), child)
        return None, SKIP
    if finding is None:
        return None, PASS
    child.say({"finding": finding_as_data(_placed(finding, subject))})
    return finding, FAIL


def _say_skip(words: str, child: Channel) -> None:
    case = None if child.case is None else child.case.as_json()
    child.say({"verdict": {"kind": SKIP, "detail": words, "case": case}})
