# SPDX-License-Identifier: MIT
"""From how the child of a rule ended to a result, also where it did not end by itself."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from usersub.check.case import Case
from usersub.check.reports.report import Result
from usersub.check.rule import FAIL, PASS, SKIP, Finding, Rule
from usersub.check.running import isolate
from usersub.check.running.isolate import Outcome

#: What the C library says of a damaged heap before it aborts.
_HEAP = re.compile(
    r"^.*(?:malloc|free|realloc|calloc|munmap_chunk|corrupted|double free|unlink|mremap_chunk|"
    r"invalid (?:size|pointer|next|chunk)|tcache|fastbin).*$",
    re.MULTILINE,
)
_STACK = re.compile(r"^.*stack smashing detected.*$", re.MULTILINE)
_OVERFLOW = re.compile(r"^.*buffer overflow detected.*$", re.MULTILINE)

#: How the words begin where a rule raised what no routine should make it raise.
FAULT_OF_CHECK = "the check itself failed"

#: What a signal means to people.
_SIGNALS = {
    "SIGSEGV": "a memory access outside of what it was given",
    "SIGBUS": "a memory access that cannot be",
    "SIGFPE": "an integer division by zero",
    "SIGILL": "an instruction that cannot be executed",
    "SIGABRT": "a call of abort",
}


@dataclass(frozen=True)
class Death:
    """Why a child died.

    Attributes:
        rule: identifier of the rule that this breaks, or "" if that is not known.
        words: what happened, to be said after "the routine"; hint: what to do.
        case: the case that the child was at, or None.
    """

    rule: str
    words: str
    hint: str = ""
    case: Case | None = None

    def finding(self, sure: bool) -> Finding:
        """What is reported; `sure` where the case alone shows it again."""
        case = self.case if sure else None
        return Finding(f"the routine {self.words}", case, hint=self.hint)


def result_of(rule: Rule, outcome: Outcome) -> Result:
    """The result of a rule whose child said something; a death is looked at by `death_of`."""
    finding = _last(outcome, "finding")
    if finding is not None:
        made = failed(rule, finding_from(finding), outcome.seconds)
        return made.but(output=outcome.output if rule.group == "process" else "")
    verdict = _last(outcome, "verdict")
    if verdict is not None:
        return result(rule, verdict["kind"], str(verdict["detail"]), outcome.seconds)
    error = _last(outcome, "error")
    if error is not None:
        return result(rule, SKIP, error_words(error), outcome.seconds).but(output=error["trace"])
    if outcome.how == isolate.RETURNED:
        return result(rule, PASS, "", outcome.seconds)
    return result(rule, SKIP, "the process ended before the rule did", outcome.seconds)


def result(rule: Rule, verdict: str, detail: str, seconds: float = 0.0) -> Result:
    """A result without a finding."""
    return Result(
        rule.id, verdict, detail, rule.requirement, rule.reference, rule.severity, seconds=seconds
    )


def failed(rule: Rule, finding: Finding, seconds: float = 0.0) -> Result:
    """The result for a finding."""
    return result(rule, FAIL, finding.detail, seconds).but(
        case=finding.case, where=finding.where, hint=finding.hint, figures=finding.figures
    )


def says_something(outcome: Outcome) -> bool:
    """Whether the rule came to a finding, a verdict or its end, whatever happened afterwards."""
    keys = ("finding", "verdict", "error")
    return outcome.how == isolate.RETURNED or any(_last(outcome, k) is not None for k in keys)


def error_words(error: dict[str, str]) -> str:
    """What an exception of a rule means to the reader of a report."""
    return (
        f"{FAULT_OF_CHECK} with {error['kind']}: {error['words']} (a fault of usersub, "
        "not of the routine)"
    )


def finding_as_data(finding: Finding) -> dict[str, Any]:
    """A finding as plain data."""
    whole = dict(vars(finding))
    whole["case"] = None if finding.case is None else finding.case.as_json()
    return whole


def finding_from(data: dict[str, Any]) -> Finding:
    """The finding that `finding_as_data` made plain."""
    case = None if data["case"] is None else Case.from_json(data["case"])
    return Finding(data["detail"], case, data["where"], data["hint"], data["figures"])


def case_of_skip(outcome: Outcome) -> Case | None:
    """The case at which a rule gave up, or None."""
    verdict = _last(outcome, "verdict")
    text = verdict.get("case") if verdict else None
    return Case.from_json(text) if text else None


def _last(outcome: Outcome, key: str) -> Any:
    return next((m[key] for m in reversed(outcome.said) if isinstance(m, dict) and key in m), None)


def death_of(outcome: Outcome) -> Death | None:
    """Why the child died; None if it did not."""
    if outcome.how == isolate.RETURNED and not outcome.late:
        return None
    if outcome.how == isolate.TIME:
        return Death(
            "process.returns",
            f"had not returned after {outcome.seconds:.1f} s",
            "give every loop an end that is reached whatever the values are",
            outcome.case,
        )
    if outcome.how == isolate.EXITED:
        return Death(
            "process.stop",
            f"ended the whole process (exit code {outcome.code}) without a word to the host",
            "return instead, and suggest a smaller increment or call XIT, which says why",
            outcome.case,
        )
    return _by_signal(outcome)


def _by_signal(outcome: Outcome) -> Death:
    name, case = outcome.signal_name, outcome.case
    for pattern, rule, words, hint in (
        (
            _STACK, "memory.stack", "wrote beyond a local array",
            "compare the sizes of local arrays with the largest index that is used",
        ),
        (
            _OVERFLOW, "memory.stack", "wrote beyond a local array or string",
            "compare the sizes of local arrays and strings with what is copied into them",
        ),
        (
            _HEAP, "memory.heap", "damaged memory that was allocated",
            "compare the sizes that are allocated with the largest index that is used, and free "
            "what was allocated once",
        ),
    ):  # fmt: skip
        said = pattern.search(outcome.output)
        if said and name in ("SIGABRT", "SIGSEGV", "SIGBUS"):
            return Death(rule, f'{words}; the C library says "{said[0].strip()}"', hint, case)
    if outcome.late:
        hint = "compare the sizes that are allocated with the largest index that is used"
        return Death("memory.heap", f"left damaged memory behind ({name})", hint, case)
    if name == "SIGKILL":
        return Death("", "was ended by the system, as it is where memory runs out", "", case)
    if name == "SIGXFSZ":
        return Death("process.output", "wrote more than 256 MiB", "write nothing", case)
    if name == "SIGXCPU":
        return Death("process.returns", "used up its computing time", "", case)
    words = _SIGNALS.get(name, "a signal")
    hint = "look at indices, divisors and pointers at this case, for example in a debugger"
    rule = "process.stop" if name == "SIGABRT" else "process.crash"
    return Death(rule, f"crashed with {name}: {words}", hint, case)
