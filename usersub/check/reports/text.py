# SPDX-License-Identifier: MIT
"""A report as text for people: failures first, then counts, then what was not checked and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from usersub.check.rule import FAIL, PASS, SKIP

if TYPE_CHECKING:
    from usersub.check.reports.report import Report, Result

_MARK = {"error": "FAIL", "warning": "WARNING", "note": "NOTE"}


def report_in_words(report: Report) -> str:
    """The whole report, as `usersub check` prints it."""
    return "\n".join(_lines(report))


def _lines(report: Report) -> Iterator[str]:
    facts = list(report.head.facts())
    width = max(len(name) for name, _ in facts)
    yield from (f"{name:<{width}}  {value}" for name, value in facts)
    for result in report.failures:
        yield ""
        yield from failure_lines(result)
    if report.expected:
        yield ""
        yield "expected failures:"
        yield from (f"  {r.rule}: {r.detail}" for r in report.expected)
    if report.surprises:
        yield ""
        yield "expected to fail, but passed:"
        yield from (f"  {r.rule}: {r.requirement}" for r in report.surprises)
    yield ""
    yield summary(report)
    yield from count_lines(report)
    yield from not_checked_lines(report)
    yield from (f"note: {note}" for note in report.notes)


def failure_lines(result: Result) -> Iterator[str]:
    """One failure: rule, what was found, where, smallest case, what to change, how to see it."""
    yield f"{_MARK[result.severity]}  {result.rule}  {result.requirement}"
    yield f"  found      {result.detail}"
    if result.severity == "note":  # nothing has to be done
        return
    if result.where:
        yield f"  where      {result.where}"
    if result.case is not None:
        first, *rest = result.words.splitlines()
        yield f"  case       {first}"
        yield from (f"             {line}" for line in rest)
    if result.hint:
        yield f"  to do      {result.hint}"
    if result.reference:
        yield f"  reference  {result.reference}"
    if result.output.strip():
        yield "  it wrote"
        yield from (f"    | {line}" for line in result.output.strip().splitlines()[:8])
    if result.reproduction:
        yield "  see it again with"
        yield from (f"    {line}" for line in result.reproduction.splitlines())


def summary(report: Report) -> str:
    """One line: how many rules with which verdict, in how much time."""
    counts = report.counts
    passed, not_checked = counts[PASS], len(report.not_checked)
    by_severity = {s: sum(r.severity == s for r in report.failures) for s in _MARK}
    words = [f"{passed} passed"]
    names = {"error": "failed", "warning": "warned", "note": "noted"}
    words += [f"{number} {names[s]}" for s, number in by_severity.items() if number]
    if report.expected:
        words.append(f"{len(report.expected)} failed as expected")
    words.append(f"{not_checked} not checked")
    return f"{report.head.title}: {', '.join(words)} in {report.seconds:.1f} s"


def count_lines(report: Report) -> Iterator[str]:
    """A table by group of rules: how many passed, failed, warned ..., in the words of `summary`."""
    groups = list(dict.fromkeys(r.group for r in report.results))
    if not groups:
        return
    names = {"error": "failed", "warning": "warned", "note": "noted"}
    used = {"error", *(r.severity for r in report.results if r.verdict == FAIL)}
    heads = ["passed", *(names[s] for s in names if s in used), "not checked"]
    width = max(len("rules"), *map(len, groups))
    yield f"  {'rules':<{width}}  {'  '.join(heads)}"
    for group in groups:
        mine = [r for r in report.results if r.group == group]
        numbers = [sum(r.verdict == PASS for r in mine)]
        failed = [r for r in mine if r.verdict == FAIL]
        numbers += [sum(r.severity == s for r in failed) for s in names if s in used]
        numbers.append(len(mine) - sum(numbers))
        row = "  ".join(f"{n:>{len(h)}}" for n, h in zip(numbers, heads, strict=True))
        yield f"  {group:<{width}}  {row}"


def not_checked_lines(report: Report) -> Iterator[str]:
    """Every rule that was not checked or does not apply, and why; rules of one reason together."""
    for title, results in (
        ("not checked:", report.of(SKIP)),
        ("does not apply:", [r for r in report.not_checked if r.verdict != SKIP]),
    ):
        reasons: dict[str, list[str]] = {}
        for result in results:
            reasons.setdefault(result.detail, []).append(result.rule)
        if reasons:
            yield title
        for reason, rules in reasons.items():
            yield f"  {', '.join(rules)}: {reason}"
