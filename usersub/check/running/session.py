# SPDX-License-Identifier: MIT
"""One routine under check: its rules in child processes, and what a dead child means for them."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from usersub.check.reports.heads import head_of, language_of
from usersub.check.reports.report import Report, Result
from usersub.check.rule import FAIL, NOT_APPLICABLE, PASS, SKIP, Finding, Rule
from usersub.check.running import begin, expectations, isolate, other_values, verdicts
from usersub.check.running.consequences import explain
from usersub.check.running.deaths import Deaths
from usersub.check.running.expectations import Expectation
from usersub.check.running.isolate import Outcome
from usersub.check.running.look import look, look_at_case
from usersub.check.running.reproduce import reproduction
from usersub.check.running.schedule import Schedule
from usersub.check.running.told import Told
from usersub.check.subjects.prepare import prepared

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject

#: Called with what is done, how much there is to do, and what is done now.
Progress = Callable[[int, int, str], None]

#: Groups of rules that look at the source, and need no routine that can be called.
_BY_SOURCE = ("signature", "symbols")
#: Seconds for a rule at most, after one was not ready in time, and where the routine does not
#: return.
_LONGEST, _HURRIED, _LOOPS = 6.0, 2.0, 0.4
#: What is said of a finding that may be about values that no surface has.
_CHOSEN = "the properties were chosen here, so look again with those of your model (--props)"
#: Share of the time in which sizes and scales are looked for.
_SHARE_OF_SEARCH = 0.5


class Session:
    """One subject under check.

    Args:
        subject: what is checked; what is not given in it is found out at the first need.
        skip, expect: rules to leave out, and failures that are expected.
        seconds: time for all of it.
        workers: processes at a time.
    """

    def __init__(
        self,
        subject: Subject,
        *,
        skip: Sequence[Expectation] = (),
        expect: Sequence[Expectation] = (),
        seconds: float = 30.0,
        workers: int | None = None,
    ) -> None:
        self._subject, self._prepared = subject, False
        self.skip, self.expect, self.seconds = tuple(skip), tuple(expect), seconds
        self.workers = workers or min(2, os.cpu_count() or 1)
        self._start = time.monotonic()
        self._late = 0
        self._deaths = Deaths(lambda: self.subject)
        self._told = Told()
        self._ones: dict[str, Result] = {}

    @property
    def subject(self) -> Subject:
        """The subject, with what was found out."""
        if not self._prepared:
            self._prepared = True
            _import_before_forks(self._subject)
            beginning = begin.found(self._subject)
            self._subject = self._subject.but(beginning=beginning)
            begin.use(self._subject)
            found = prepared(self._subject, _SHARE_OF_SEARCH * self.seconds)
            told = begin.origin(beginning)
            self._subject = found.but(origin={**found.origin, **told})
        begin.use(self._subject)
        return self._subject

    # All rules.

    def report(self, rules: Sequence[Rule], progress: Progress | None = None) -> Report:
        """Looks at all rules, up to `workers` at a time."""
        self._start = time.monotonic()
        if progress is not None:
            progress(0, len(rules), "finding out what the routine reads")
        results: dict[str, Result] = {}
        subject = self.subject
        self._deaths.probe()
        begin = self._start
        if self._deaths.loops:
            self._start = time.monotonic()  # or the rules would be left without time
        self._look(rules, results, progress)
        self._deaths.settle(rules, results)
        self._told.settle(subject, rules, results)
        explain(subject, results, list(results))
        self._try_other_values(rules, results)
        ordered = tuple(self._dressed(rule, results[rule.id]) for rule in rules)
        notes = tuple(self._notes(rules))
        return Report(head_of(subject), ordered, notes, time.monotonic() - begin, subject)

    def _look(
        self, rules: Sequence[Rule], results: dict[str, Result], progress: Progress | None
    ) -> None:
        """Looks at the rules; those that shared a process with a routine that proves to damage
        memory or to end its process, and were not passed, are looked at again alone."""
        opened = partial(self._opened, results)
        until = self._start + self.seconds
        schedule = Schedule(self.subject, rules, self.workers, self._limit, opened, until)
        doubtful: list[Rule] = []
        for batch, outcome in isolate.run_all(schedule, self.workers):
            known = {rule.id: rule for rule in batch}
            for id, own in isolate.stages(outcome):
                self._heard(known[id], own, results)
                shared = len(batch) > 1 and own.how != isolate.TIME
                if shared and results[id].verdict in (FAIL, SKIP):
                    doubtful.append(known[id])
                del known[id]
            if len(known) == len(batch) and outcome.how != isolate.RETURNED:
                words = f"its process could not be started: {outcome.output.strip() or 'no reason'}"
                results |= {id: verdicts.result(r, SKIP, words) for id, r in known.items()}
            elif known:
                schedule.again(list(known.values()), alone=self._harmful(results))
            if doubtful and self._harmful(results):
                schedule.separate()
                schedule.again(doubtful, alone=True)
                doubtful = []
            if progress is not None:
                progress(len(results), len(rules), batch[-1].id)

    def _harmful(self, results: dict[str, Result]) -> bool:
        """Whether the routine is known to do harm to its process."""
        failed = any(
            r.verdict == FAIL and r.group in ("memory", "process") for r in results.values()
        )
        return failed or self._deaths.any

    def _heard(self, rule: Rule, outcome: Outcome, results: dict[str, Result]) -> None:
        explained = verdicts.says_something(outcome)
        self._late += not explained and outcome.how == isolate.TIME
        death = verdicts.death_of(outcome)
        if death is not None:
            self._deaths.note(rule.id, death, explained)
        results[rule.id] = self._result(rule, outcome)
        self._told.note(rule, results[rule.id], verdicts.case_of_skip(outcome))

    def _opened(self, results: dict[str, Result], rule: Rule) -> bool:
        """Whether a rule is to be looked at; if not, its result says why."""
        early = self._without_looking(rule)
        if early is None and time.monotonic() > self._start + self.seconds:
            early = verdicts.result(
                rule, SKIP, f"no time was left of the {self.seconds:g} s for this interface"
            )
        if early is not None and rule.id not in results:
            results[rule.id] = early
        return early is None

    def _limit(self, rule: Rule) -> float:
        if self._deaths.loops:
            return min(rule.seconds, _LOOPS)
        return min(rule.seconds, _HURRIED if self._late else _LONGEST)

    def _without_looking(self, rule: Rule) -> Result | None:
        """The result of a rule that needs no look, or cannot be looked at."""
        subject = self.subject
        left_out = expectations.chosen(self.skip, rule.id, subject.interface.name)
        if left_out is not None:
            words = f"left out as asked {left_out.words}".strip()
            return verdicts.result(rule, SKIP, words)
        if subject.interface.name not in rule.interfaces:
            names = ", ".join(n.upper() for n in rule.interfaces)
            return verdicts.result(rule, NOT_APPLICABLE, f"it is about {names}")
        language = language_of(subject)
        if rule.languages and language not in rule.languages:
            names = ", ".join(rule.languages)
            return verdicts.result(rule, NOT_APPLICABLE, f"it is about routines in {names}")
        if subject.routine is None and rule.group not in _BY_SOURCE:
            return verdicts.result(rule, SKIP, f"the routine cannot be loaded: {subject.failure}")
        return None

    def _result(self, rule: Rule, outcome: Outcome) -> Result:
        if verdicts.says_something(outcome):
            return verdicts.result_of(rule, outcome)
        death = verdicts.death_of(outcome)
        assert death is not None
        return verdicts.result(rule, SKIP, f"the routine {death.words}", outcome.seconds)

    def _try_other_values(self, rules: Sequence[Rule], results: dict[str, Result]) -> None:
        """Findings that do not show at other properties are warnings, if nobody gave these."""
        if self._late or not other_values.are_chosen(self.subject):
            return
        for rule in rules:
            found = results[rule.id]
            suspect = found.verdict == FAIL and found.severity == "error"
            if not suspect or rule.group not in other_values.GROUPS:
                continue
            props = other_values.harmless(self.subject, rule, self._limit(rule))
            if props is not None:
                shown = ",".join(f"{p:g}" for p in props)
                hint = f"{found.hint.rstrip('.')}; with --props {shown} the rule passes".lstrip(
                    "; "
                )
                results[rule.id] = found.but(severity="warning", hint=hint)

    def _notes(self, rules: Sequence[Rule]) -> Iterator[str]:
        lists = (*self.skip, *self.expect)
        if lists:
            from usersub.check.rules import all_rules

            yield from expectations.unknown(lists, {*all_rules(), *(rule.id for rule in rules)})

    # Single rules.

    def one(self, rule: Rule) -> Result:
        """Looks at one rule. A process that dies fails the rule that was looked at."""
        early = self._without_looking(rule)
        if early is not None:
            return self._dressed(rule, early)
        outcome = isolate.run(partial(look, rule, self.subject), self._limit(rule))
        self._ones[rule.id] = self._alone(rule, outcome)
        explain(self.subject, self._ones, [rule.id])
        return self._dressed(rule, self._ones[rule.id])

    def again(self, rule: Rule, case: Case | None, apart: bool = True) -> Finding | None:
        """Looks at one rule, at one case if it is given, and prints what it finds."""
        work = partial(look_at_case, rule, self.subject, case)
        if not apart:
            found = look_at_case(rule, self.subject, case, None)
            print(found.detail if found is not None else f"{rule.id}: nothing was found")
            return found
        result = self._alone(rule, isolate.run(work, 3.0 * rule.seconds))
        print(_in_words(result))
        if result.verdict != FAIL:
            return None
        return Finding(result.detail, result.case, result.where, result.hint, result.figures)

    def _alone(self, rule: Rule, outcome: Outcome) -> Result:
        death = verdicts.death_of(outcome)
        made = self._result(rule, outcome)
        heap = death is not None and death.rule == "memory.heap"
        if death is None or not death.rule or (verdicts.says_something(outcome) and not heap):
            return made
        if made.verdict == FAIL:
            return made
        finding = self._deaths.proof(death)
        return made if finding is None else verdicts.failed(rule, finding, outcome.seconds)

    def _dressed(self, rule: Rule, result: Result) -> Result:
        """The result with interface, reproduction, and whether it was expected."""
        subject = self.subject
        name = subject.interface.name
        changes: dict[str, Any] = {"interface": name, "precision": subject.precision}
        changes["expected"] = (
            result.verdict in (PASS, FAIL)
            and expectations.chosen(self.expect, rule.id, name) is not None
        )
        if result.verdict == FAIL:
            case = result.case if rule.judge is not None else None
            if case is None and result.case is not None and result.case.props is not None:
                subject = subject.but(props=result.case.props)  # it shows with these alone
            changes["reproduction"] = reproduction(subject, rule.id, case)
            if (
                other_values.are_chosen(subject)
                and rule.group in other_values.GROUPS
                and result.hint
            ):
                changes["hint"] = f"{result.hint.rstrip('.')}; {_CHOSEN}"
        return result.but(**changes)


def _in_words(result: Result) -> str:
    from usersub.check.reports.text import failure_lines

    if result.verdict == FAIL:
        return "\n".join(failure_lines(result))
    return f"{result.rule}: {result.verdict} {result.detail}".strip()


def _import_before_forks(subject: Subject) -> None:
    """Imports what every child would import for itself."""
    import usersub.driver  # noqa: F401
    import usersub.driver.coefficient
    import usersub.driver.explicit
    import usersub.driver.standard  # noqa: F401
    from usersub.check import respond  # noqa: F401
    from usersub.check.respond import coefficient, explicit, standard  # noqa: F401
