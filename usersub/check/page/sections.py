# SPDX-License-Identifier: MIT
"""Parts of a report's page: head, counts, all rules, and what was not checked."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from usersub.check.page.html import Content, Html, code, element, facts, join, paragraph, table
from usersub.check.rule import FAIL, NOT_APPLICABLE, PASS, SKIP

if TYPE_CHECKING:
    from usersub.check.reports.report import Report, Result

#: Sign and words of each verdict: neither needs colour.
SIGNS = {
    PASS: ("\u2713", "pass"),
    FAIL: ("\u2717", "fail"),
    SKIP: ("?", "not checked"),
    NOT_APPLICABLE: ("\u2013", "does not apply"),
}
#: Sign and name of a failure, by severity.
FOUND = {"error": ("\u2717", "failure"), "warning": ("!", "warning"), "note": ("i", "note")}


def verdict(result: Result) -> Html:
    """Sign and words of a verdict."""
    sign, words = SIGNS[result.verdict]
    counts = result.verdict == FAIL and not result.expected and result.severity != "note"
    if result.verdict == FAIL:
        sign, words = FOUND[result.severity]
        words = "failed as expected" if result.expected else words
    elif result.verdict == PASS and result.expected:
        words = "pass, but was expected to fail"
    shown = element("span", sign, aria_hidden="true")
    return element("span", shown, f" {words}", class_="mark fail" if counts else "mark")


def count(number: int, word: str) -> str:
    """A number with its word."""
    return f"{number or 'no'} {word}{'' if number == 1 else 's'}"


def counted(report: Report) -> str:
    """Counts of the verdicts in one sentence."""
    by = {s: sum(r.severity == s for r in report.failures) for s in FOUND}
    parts = [count(by["error"], "failure"), count(by["warning"], "warning")]
    if by["note"]:
        parts.append(count(by["note"], "note"))
    if report.expected:
        parts.append(f"{len(report.expected)} failed as expected")
    if report.surprises:
        parts.append(f"{len(report.surprises)} passed that were expected to fail")
    parts.append(f"{len(report.of(PASS))} passed")
    parts.append(f"{len(report.not_checked)} not checked or not applicable")
    return f"{', '.join(parts)}, of {count(len(report.results), 'rule')}.".capitalize()


def head(report: Report) -> Html:
    """What was checked, with what, and at which values."""
    values = tuple(getattr(report.head, "values", ()))
    named = {v.name for v in values}
    pairs: list[tuple[str, Content]] = [p for p in report.head.facts() if p[0] not in named]
    parts: list[Content] = [facts((n, v) for n, v in pairs if v)]
    if values:
        rows = [(v.name, v.value, v.origin) for v in values]
        caption = "Values at which it was checked. Units are those of the model."
        parts.append(table(caption, ("name", "value", "how it was found"), rows))
    return join(parts)


def groups(report: Report) -> Html:
    """Counts by group of rules."""
    names = list(dict.fromkeys(r.group for r in report.results))
    rows = []
    for name in names:
        mine = [r for r in report.results if r.group == name]
        numbers = [sum(r.verdict == v for r in mine) for v in SIGNS]
        rows.append((name, *map(str, numbers)))
    top = ("rules", *(words for _, words in SIGNS.values()))
    return table("Verdicts by group of rules", top, rows, class_="numbers")


def all_rules(report: Report, anchors: dict[int, str]) -> Html:
    """Every rule with its verdict; `anchors` are those of failures by place in the report."""
    rows = []
    for index, result in enumerate(report.results):
        name: Content = code(result.rule)
        if index in anchors:
            name = element("a", name, href=f"#{anchors[index]}")
        rows.append((name, result.requirement, verdict(result), result.severity, result.reference))
    top = ("rule", "what has to hold", "verdict", "weight", "reference")
    return table("Every rule with its verdict", top, rows)


def not_checked(report: Report) -> Html:
    """The rules that did not apply or could not be checked, and why."""
    parts = [
        _reasons("Rules that could not be checked", report.of(SKIP)),
        _reasons("Rules that do not apply", report.of(NOT_APPLICABLE)),
    ]
    return join(parts) or paragraph("Every rule was checked." if report.results else "No rule ran.")


def _reasons(caption: str, results: Iterable[Result]) -> Html:
    by_reason: dict[str, list[str]] = {}
    for result in results:
        by_reason.setdefault(result.detail, []).append(result.rule)
    if not by_reason:
        return Html("")
    rows = [(why, join(map(code, rules), ", ")) for why, rules in by_reason.items()]
    count = sum(map(len, by_reason.values()))
    return table(f"{caption} ({count})", ("why", "rules"), rows, class_="reasons")
