# SPDX-License-Identifier: MIT
"""Reports: what was checked, with what, what each rule found, and what was not checked."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from usersub.check.rule import FAIL, NOT_APPLICABLE, PASS, SEVERITIES, SKIP, Finding
from usersub.check.words import case_in_words

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject

#: Verdicts in the order in which people want to read them.
VERDICTS = (FAIL, PASS, SKIP, NOT_APPLICABLE)


@dataclass(frozen=True)
class Result:
    """What one rule found in one routine.

    Attributes:
        rule, requirement, reference, severity: those of the rule.
        verdict: "pass", "fail", "skip" (it applies but was not checked) or "not-applicable".
        detail: one sentence: what was found, or why nothing was checked; "" for a pass.
        interface, precision: of the routine.
        case: smallest case that shows the failure; None where no call is needed to see it.
        where: "file:line" in the routine's source, or "".
        hint: what to change, in one sentence, or "".
        reproduction: three lines of Python that show the failure again, or "".
        seconds: how long the rule took.
        figures: numbers for figures, by name.
        expected: the failure was announced (`expect`).
        output: first lines that the routine wrote while this rule ran, where it failed.
    """

    rule: str
    verdict: str
    detail: str = ""
    requirement: str = ""
    reference: str = ""
    severity: str = "error"
    interface: str = ""
    precision: str = "double"
    case: Case | None = None
    where: str = ""
    hint: str = ""
    reproduction: str = ""
    seconds: float = 0.0
    figures: dict[str, Any] = field(default_factory=dict, repr=False)
    expected: bool = False
    output: str = ""

    @property
    def words(self) -> str:
        """The smallest case in words, or ""."""
        return "" if self.case is None else case_in_words(self.case, self.interface)

    @property
    def finding(self) -> Finding | None:
        """What was found, where the rule failed."""
        if self.verdict != FAIL:
            return None
        return Finding(self.detail, self.case, self.where, self.hint, self.figures)

    @property
    def group(self) -> str:
        """The part of the rule's identifier before the point."""
        return self.rule.partition(".")[0]

    def but(self, **changes: Any) -> Result:
        """The same result but for the attributes given."""
        return replace(self, **changes)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON; the case as its own JSON object and in words."""
        import json

        smallest = None
        if self.case is not None:
            smallest = {"case": json.loads(self.case.as_json()), "words": self.words}
        return {
            "rule": self.rule,
            "verdict": self.verdict,
            "detail": self.detail,
            "smallest_input": smallest,
            "where": self.where,
            "interface": self.interface,
            "precision": self.precision,
            "severity": self.severity,
            "expected": self.expected,
            "requirement": self.requirement,
            "reference": self.reference,
            "hint": self.hint,
            "reproduction": self.reproduction,
            "seconds": round(self.seconds, 4),
            "figures": self.figures,
            "output": self.output,
        }


@dataclass(frozen=True)
class Value:
    """Something at which the routine was checked: `name`, `value` in words, how it was found."""

    name: str
    value: str
    origin: str


@dataclass(frozen=True)
class Head:
    """What was checked, and with what.

    Attributes:
        routine: name of the routine.
        file: its file, or "".
        interface, generation, precision, language: as of the routine.
        compiler, flags: words of the compiler, its flags; empty where nothing was compiled.
        versions: of usersub, Python, numpy and numba, by name.
        abi_version, abi_hash: of the argument tables.
        date: local time, ISO 8601.
        values: properties, sizes and scales, and how each was found.
        law: built-in law that the routine claims to be, or "".
    """

    routine: str
    file: str = ""
    interface: str = ""
    generation: str = ""
    precision: str = "double"
    language: str = ""
    compiler: str = ""
    flags: tuple[str, ...] = ()
    versions: dict[str, str] = field(default_factory=dict)
    abi_version: int = 0
    abi_hash: str = ""
    date: str = ""
    values: tuple[Value, ...] = ()
    law: str = ""

    @property
    def title(self) -> str:
        """Routine, interface and precision in a few words."""
        return f"{self.routine}: {self.interface.upper()}, {self.precision} precision"

    def facts(self) -> Iterator[tuple[str, str]]:
        """Names and words, in the order of a page."""
        yield "routine", self.routine
        if self.file:
            yield "file", self.file
        generation = f", generation {self.generation}" if self.interface == "fric_coef" else ""
        yield "interface", f"{self.interface.upper()}{generation}, {self.precision} precision"
        yield "language", self.language
        if self.compiler:
            yield "compiler", self.compiler
            yield "flags", " ".join(self.flags)
        if self.law:
            yield "law", self.law
        for value in self.values:
            yield value.name, f"{value.value} ({value.origin})" if value.origin else value.value
        yield "versions", ", ".join(f"{name} {v}" for name, v in self.versions.items())
        yield "tables", f"version {self.abi_version}, hash {self.abi_hash}"
        yield "date", self.date

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON."""
        whole = dict(vars(self))
        whole["flags"] = list(self.flags)
        whole["values"] = [dict(vars(value)) for value in self.values]
        return whole


@dataclass(frozen=True)
class Report:
    """What the rules found in one routine behind one interface in one precision.

    Attributes:
        head: what was checked, and with what.
        results: one for each rule, in the order of the rules.
        notes: sentences on what the reader should know besides (unknown rules in a file ...).
        seconds: how long all of it took.
        subject: what was checked; None in a report that came from another process.
    """

    head: Head
    results: tuple[Result, ...] = ()
    notes: tuple[str, ...] = ()
    seconds: float = 0.0
    subject: Subject | None = field(default=None, repr=False, compare=False)

    def __reduce__(self) -> tuple:
        # A subject holds machine code, which stays in its process.
        return Report, (self.head, self.results, self.notes, self.seconds)

    def __getitem__(self, rule: str) -> Result:
        for result in self.results:
            if result.rule == rule:
                return result
        raise KeyError(rule)

    def of(self, verdict: str) -> tuple[Result, ...]:
        """The results with that verdict."""
        return tuple(r for r in self.results if r.verdict == verdict)

    @property
    def failures(self) -> tuple[Result, ...]:
        """Failures that nobody expected, the gravest first."""
        found = [r for r in self.of(FAIL) if not r.expected]
        return tuple(sorted(found, key=lambda r: SEVERITIES.index(r.severity)))

    @property
    def expected(self) -> tuple[Result, ...]:
        """Failures that were announced."""
        return tuple(r for r in self.of(FAIL) if r.expected)

    @property
    def surprises(self) -> tuple[Result, ...]:
        """Announced failures that passed."""
        return tuple(r for r in self.of(PASS) if r.expected)

    @property
    def not_checked(self) -> tuple[Result, ...]:
        """Rules that did not apply or could not be checked."""
        return (*self.of(SKIP), *self.of(NOT_APPLICABLE))

    def ok(self, strict: bool = False) -> bool:
        """Whether no error was found; with `strict` no warning either. An announced failure that
        passes is not all right: the announcement is wrong."""
        grave = ("error", "warning") if strict else ("error",)
        return not self.surprises and not any(r.severity in grave for r in self.failures)

    @property
    def counts(self) -> dict[str, int]:
        """Number of results by verdict."""
        return {verdict: len(self.of(verdict)) for verdict in VERDICTS}

    def as_dict(self) -> dict[str, Any]:
        """Plain data for JSON, the results included."""
        return {
            "head": self.head.as_dict(),
            "ok": self.ok(),
            "counts": self.counts,
            "seconds": round(self.seconds, 3),
            "notes": list(self.notes),
            "results": [r.as_dict() for r in self.results],
        }

    def __str__(self) -> str:
        from usersub.check.reports.text import report_in_words

        return report_in_words(self)
