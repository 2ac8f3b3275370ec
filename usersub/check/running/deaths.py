# SPDX-License-Identifier: MIT
"""Processes that a routine ended: which rule that breaks, and the case that proves it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from usersub.check import cases
from usersub.check.rule import FAIL, NOT_APPLICABLE, SKIP, Finding, Rule
from usersub.check.running import isolate, verdicts
from usersub.check.running.look import run_case
from usersub.check.running.shrink import shrunk
from usersub.check.running.verdicts import Death
from usersub.check.subjects.values import first

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.reports.report import Result
    from usersub.check.subject import Subject

#: The rule that an endless loop breaks, and that of a damaged heap, which shows late.
LOOP, HEAP = "process.returns", "memory.heap"
#: Groups of rules that explain why a process died.
_EXPLAIN = ("memory", "process")
#: Seconds in which a case that a child died at has to die again, to be the proof.
_PROOF = 3.0
#: Seconds in which an ordinary case ends if the routine is not very slow.
_PROBE = 2.0
#: Seconds for a part of a case that does not return.
_HALF = 0.4
#: Points of cases with many loads and motions.
_MANY = 512
#: Numbers of properties below this are tried.
_PROPS = 7
#: Seconds for making the case of a death smaller.
_SMALLER = 2.0


class Deaths:
    """The deaths of one check.

    Attributes:
        loops: that the routine does not return has been proved.
    """

    def __init__(self, subject: Callable[[], Subject]) -> None:
        self._subject = subject
        self._deaths: dict[str, Death] = {}
        self._proofs: dict[str, Finding | None] = {}
        self.loops = False
        self._searched = False

    @property
    def any(self) -> bool:
        """Whether there was a death."""
        return bool(self._deaths) or self.loops

    def probe(self) -> None:
        """Runs an ordinary case, so that an endless loop is known before it costs time."""
        subject = self._subject()
        if subject.routine is None:
            return
        self._prove_loop([None, *_more(subject)] if _hung(subject) else [None])

    def _prove_loop(self, candidates: Sequence[Case | None]) -> None:
        """Looks for an ordinary case at which the routine does not return, and makes it small."""
        subject = self._subject()
        for candidate in candidates:
            whole = candidate or cases.slipping(subject)
            death = self._loop_at(whole, _PROBE)
            if death is None:
                continue
            self.loops = True
            self._proofs[LOOP] = self._shorter(self._fewer(whole), death).finding(True)
            return

    def _fewer(self, case: Case) -> Case:
        """The half of the points, again and again, as long as it does not return."""
        while case.points > 1:
            half = case.points // 2
            parts = (case.only(range(half)), case.only(range(half, case.points)))
            part = next((p for p in parts if self._loop_at(p, _HALF)), None)
            if part is None:
                break
            case = part
        return case

    def _shorter(self, case: Case, death: Death) -> Death:
        """The first increments up to the one that does not return; the others take no time."""
        for last in range(2, len(case.steps) + 1):
            found = self._loop_at(case.but(steps=case.steps[:last]), _PROBE)
            if found is not None:
                return found
        return death

    def _loop_at(self, case: Case, seconds: float) -> Death | None:
        death = self._death_at(case, seconds)
        return death if death is not None and death.rule == LOOP else None

    def note(self, rule: str, death: Death, explained: bool) -> None:
        """Takes note of a death while `rule` was looked at.

        Args:
            explained: the rule had come to its answer before.
        """
        if explained and death.rule != HEAP:
            return
        self._deaths[rule] = death
        if death.rule == LOOP:
            self.loops = self.loops or self.proof(death) is not None
            if not self.loops and not self._searched:
                self._searched = True
                self._prove_loop(_more(self._subject()))

    def proof(self, death: Death) -> Finding | None:
        """The finding for a death, with the case if that alone shows the death again.

        A process that was only too slow is no finding: the routine may not be to blame.
        """
        if self._proofs.get(death.rule) is None:
            self._proofs[death.rule] = self._proved(death)
        return self._proofs[death.rule]

    def _proved(self, death: Death) -> Finding | None:
        case = death.case
        if case is None or self._subject().routine is None:
            return None if death.rule == LOOP else death.finding(False)
        again = self._death_at(case, _PROOF)
        if again is None or again.rule != death.rule:
            return None if death.rule == LOOP else death.finding(False)
        if death.rule == LOOP:
            return again.finding(True)
        *_, finding = (death.finding(True), *self._smaller(death))
        return finding

    def _smaller(self, death: Death) -> Sequence[Finding]:
        def judged(case: Case) -> Finding | None:
            again = self._death_at(case, _PROOF)
            same = again is not None and again.rule == death.rule
            return replace(death, case=case).finding(True) if same else None

        return tuple(shrunk(death.finding(True), judged, _SMALLER))

    def _death_at(self, case: Case, seconds: float) -> Death | None:
        return verdicts.death_of(isolate.run(partial(run_case, self._subject(), case), seconds))

    def settle(self, rules: Sequence[Rule], results: dict[str, Result]) -> None:
        """Makes a failure of what happened, of the rule that it is about, once; the rules that
        could not be looked at refer to it."""
        known = {rule.id: rule for rule in rules}
        if self.loops and LOOP in known and results[LOOP].verdict != FAIL:
            finding = self._proofs[LOOP]
            assert finding is not None
            results[LOOP] = verdicts.failed(known[LOOP], finding)
        for id, death in self._deaths.items():
            result = results[id]
            if result.verdict == FAIL or (result.verdict != SKIP and death.rule != HEAP):
                continue
            why = self._why(death, known, results) or self._made(id, death, known, results)
            if why and why != id and result.verdict == SKIP:
                results[id] = result.but(detail=f"{result.detail}; see {why}")

    def _why(self, death: Death, known: dict[str, Rule], results: dict[str, Result]) -> str:
        """The rule that has failed already and explains the death, or ""."""
        if death.rule == LOOP:
            failed = [LOOP] if LOOP in known and results[LOOP].verdict == FAIL else []
        else:
            failed = [
                id
                for id, rule in known.items()
                if rule.group in _EXPLAIN and id != LOOP and results[id].verdict == FAIL
            ]
        return failed[0] if failed else ""

    def _made(
        self, id: str, death: Death, known: dict[str, Rule], results: dict[str, Result]
    ) -> str:
        """Fails the rule that the death is about, or the one that was looked at."""
        finding = self.proof(death) if death.rule else None
        if finding is None:
            return ""
        guilty = known.get(death.rule, known[id])
        if results[guilty.id].verdict == NOT_APPLICABLE:
            guilty = known[id]
        results[guilty.id] = verdicts.failed(guilty, finding, results[id].seconds)
        return guilty.id


def _hung(subject: Subject) -> bool:
    """Whether the routine did not return while sizes and scales were looked for."""
    return any("did not return" in words for words in subject.origin.values())


def _more(subject: Subject) -> list[Case]:
    """Ordinary cases with many loads and motions, and with more properties if none were given."""
    found = [cases.slipping(subject, _MANY), cases.changing_load(subject, _MANY)]
    if subject.origin.get("props") != "given":
        one = cases.slipping(subject)
        found += [one.but(props=first(n)) for n in range(len(subject.props) + 1, _PROPS)]
    return found
