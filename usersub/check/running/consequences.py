# SPDX-License-Identifier: MIT
"""Failures that only follow from another: what a routine does after it has read or written memory
that is not its own, or a local variable that was never set, says nothing about friction."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

from usersub.check.probing.watching import MEMORY, watch
from usersub.check.rule import FAIL, SKIP
from usersub.check.running import isolate
from usersub.check.running.verdicts import FAULT_OF_CHECK
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.reports.report import Result
    from usersub.check.running.inside import Channel
    from usersub.check.subject import Subject

#: The rule about local variables that are not set, and what the checked drivers call that.
_UNSET_RULE, _UNSET = "data.uninitialised", ("uninitialised",)
#: Groups of rules whose failures do not follow from what a call does.
_FIRST = ("memory", "signature", "symbols", "precision")
#: The rule about state that is kept inside, and what fails where results are not repeated.
_REPEAT = "repeat.same"
_OF_KEPT = (
    _UNSET_RULE, "repeat.threads", "extremes.not-a-number", "blocks", "zero", "pressure", "bound",
    "frame", "slip", "multiplier", "energy", "tangent", "limits",
)  # fmt: skip
_OF_UNSET = ("repeat", "blocks")
#: Seconds for one case.
_SECONDS = 2.0


def explain(subject: Subject, results: dict[str, Result], ids: Iterable[str]) -> None:
    """Turns failures `ids` into rules that could not be checked, where the case of the failure
    shows a fault of memory that has failed a rule of its own."""
    if subject.routine is None:
        return
    asked = [i for i in ids if results[i].group not in _FIRST]
    memory = [r.rule for r in results.values() if r.group == "memory" and r.verdict == FAIL]
    if memory:
        words = "touches memory outside of the arguments"
        _explain(subject, results, asked, MEMORY, words, memory[0])
        for id, result in results.items():  # a damaged interpreter raises what it likes
            if result.verdict == SKIP and result.detail.startswith(FAULT_OF_CHECK):
                results[id] = _told(result, f"the routine damages memory; see {memory[0]}")
    unset = results.get(_UNSET_RULE)
    if unset is not None and unset.verdict == FAIL:
        words = "uses a local variable that was not set"
        others = [i for i in asked if i != _UNSET_RULE]
        _explain(subject, results, others, _UNSET, words, _UNSET_RULE)
    _follow(subject, results, asked)


def _follow(subject: Subject, results: dict[str, Result], ids: Iterable[str]) -> None:
    """Failures that follow, at whatever case, from results that are not repeated."""
    kept, unset = _failed(results, _REPEAT), _failed(results, _UNSET_RULE)
    if not (kept or unset):
        return
    keeps = kept and _keeps(subject)
    if kept and unset:  # only data that outlive a call can be kept
        kept, unset = keeps, not keeps
    cause = _REPEAT if kept else _UNSET_RULE
    following: tuple[str, ...] = _OF_KEPT if kept else _OF_UNSET
    if kept and not keeps and "local variable" in results[_REPEAT].hint:  # chance
        following += ("repeat.order", "history")
    for id in ids:
        follows = id in following or results[id].group in following
        if follows and id != cause and _failed(results, id):
            results[id] = _told(results[id], f"the routine does not repeat itself; see {cause}")


def _failed(results: dict[str, Result], id: str) -> bool:
    return id in results and results[id].verdict == FAIL


def _keeps(subject: Subject) -> bool:
    code = subject.file.code if subject.file is not None else None
    return code is None or bool(code.build(subject.precision).shared)


def _told(result: Result, detail: str) -> Result:
    return result.but(
        verdict=SKIP, detail=detail, case=None, where="", hint="", figures={}, output=""
    )


def _explain(
    subject: Subject,
    results: dict[str, Result],
    ids: Iterable[str],
    kinds: tuple[str, ...],
    words: str,
    cause: str,
) -> None:
    cases = {}
    for id in ids:
        case = results[id].case
        if results[id].verdict == FAIL and case is not None:
            cases[id] = case
    for id, seen in _seen(subject, cases, kinds).items():
        results[id] = _told(results[id], f"its case {words} ({seen['sentence']}); see {cause}")


def _seen(
    subject: Subject, cases: dict[str, Case], kinds: tuple[str, ...]
) -> dict[str, dict[str, Any]]:
    """The fault of one of the kinds that each case shows, by the key of the case."""
    found: dict[str, dict[str, Any]] = {}
    left = dict(cases)
    while left:
        outcome = isolate.run(partial(_watch, subject, dict(left), kinds), _SECONDS)
        done = isolate.stages(outcome)
        for key, own in done:
            del left[key]
            for said in own.said:
                if "seen" in said:
                    found[key] = said["seen"]
        if not done:
            break
    return found


def _watch(
    subject: Subject, cases: dict[str, Case], kinds: tuple[str, ...], child: Channel
) -> None:
    for key, case in cases.items():
        child.stage(key, _SECONDS)
        try:
            seen = watch(subject.but(tell=None), case, kinds)
        except Error:
            continue  # the case is not one that a checked driver runs
        if seen is not None:
            child.say({"seen": asdict(seen)})
