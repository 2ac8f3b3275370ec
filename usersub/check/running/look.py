# SPDX-License-Identifier: MIT
"""What a child process does with a rule: look, say what was found, and make the case smaller."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from usersub.check.rule import (
    NOT_APPLICABLE,
    SKIP,
    CannotCheck,
    Finding,
    NotApplicable,
    Rule,
    as_finding,
)
from usersub.check.running.verdicts import finding_as_data
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.running.inside import Channel
    from usersub.check.subject import Subject


def look(rule: Rule, subject: Subject, child: Channel) -> None:
    """Looks at a rule, says the first finding, then the same at smaller and smaller cases."""
    subject = subject.but(tell=child.tell)
    finding = _say(lambda: next(iter(rule.look(subject) or ()), None), child)
    if finding is None or finding.case is None or rule.judge is None:
        return
    from usersub.check.running.shrink import smaller

    for found in smaller(rule, subject, finding):
        child.say({"finding": finding_as_data(found)})


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

    told = subject if child is None else subject.but(tell=child.tell)
    return found() if child is None else _say(found, child)


def run_case(subject: Subject, case: Case, child: Channel) -> None:
    """Runs a case through the driver; what it gives does not matter."""
    subject.but(tell=child.tell).respond(case)


def _say(find: Any, child: Channel) -> Finding | None:
    try:
        finding = find()
    except NotApplicable as reason:
        child.say({"verdict": {"kind": NOT_APPLICABLE, "detail": str(reason)}})
    except CannotCheck as reason:
        _say_skip(str(reason), child)
    except Error as error:
        words = f"it could not be checked: {error}"
        _say_skip(" ".join(words.split()), child)
    else:
        if finding is not None:
            child.say({"finding": finding_as_data(finding)})
        return finding
    return None


def _say_skip(words: str, child: Channel) -> None:
    case = None if child.case is None else child.case.as_json()
    child.say({"verdict": {"kind": SKIP, "detail": words, "case": case}})
