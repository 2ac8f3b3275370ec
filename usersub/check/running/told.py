# SPDX-License-Identifier: MIT
"""What a rule was told of another rule's subject: a routine that stops the analysis in an ordinary
case, or asks for an impossible increment, has broken a rule whoever was looking."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from usersub.check.rule import FAIL, SKIP, Finding, Rule
from usersub.check.running import isolate, verdicts

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.reports.report import Result
    from usersub.check.running.inside import Channel
    from usersub.check.subject import Subject

#: Groups of rules whose cases are those of any analysis.
_ORDINARY = (
    "repeat", "blocks", "history", "friction", "bound", "frame", "slip", "energy", "multiplier",
    "pnewdt", "tangent",
)  # fmt: skip
#: What a failure says, by the rule that it breaks, and what to do.
_SAID = {
    "process.stop": (
        re.compile(r"ended with (?:ERROR )?(?:STOP|XIT|XPLB_EXIT|exit)"),
        "return instead, and suggest a smaller increment by PNEWDT where there is one",
    ),
    "process.returns": (
        re.compile(r"did not return"),
        "give every loop an end that is reached whatever the values are",
    ),
    "pnewdt.positive": (
        re.compile(r"returned PNEWDT"),
        "suggest a factor above zero, or leave PNEWDT alone",
    ),
}
#: Seconds in which a case has to show again what was said of it.
_SECONDS = 3.0


class Told:
    """What the rules that could not be checked were told."""

    def __init__(self) -> None:
        self._told: dict[str, tuple[str, Case]] = {}

    def note(self, rule: Rule, result: Result, case: Case | None) -> None:
        """Takes note of why `rule` could not be checked at `case`."""
        if result.verdict != SKIP or case is None or rule.group not in _ORDINARY:
            return
        for id, (pattern, _) in _SAID.items():
            if pattern.search(result.detail):
                self._told.setdefault(id, (rule.id, case))

    def settle(self, subject: Subject, rules: Sequence[Rule], results: dict[str, Result]) -> None:
        """Fails the rules that are about what was said, where the case shows it again."""
        known = {rule.id: rule for rule in rules}
        for id, (_, case) in self._told.items():
            if id not in known or results[id].verdict == FAIL:
                continue
            pattern, hint = _SAID[id]
            words = _failure(subject, case)
            if pattern.search(words):
                results[id] = verdicts.failed(known[id], Finding(words, case, hint=hint))


def _failure(subject: Subject, case: Case) -> str:
    """The words of the failure that ends a case, or ""."""

    def work(child: Channel) -> None:
        for answer in subject.but(tell=child.tell).respond(case):
            if answer.failure is not None:
                child.say({"failure": " ".join(str(answer.failure).split())})

    outcome = isolate.run(work, _SECONDS)
    return next((said["failure"] for said in outcome.said if "failure" in said), "")
