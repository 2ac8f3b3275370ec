# SPDX-License-Identifier: MIT
"""The whole page: an overview of the reports, then one after the other, failures first."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from usersub.check.page import sections
from usersub.check.page.failure import failure
from usersub.check.page.html import Content, Html, element, join, paragraph, section, table
from usersub.check.page.pictures import of_routine
from usersub.check.page.safely import Budget
from usersub.check.page.style import STYLE
from usersub.check.rule import FAIL, PASS

if TYPE_CHECKING:
    from usersub.check.reports.report import Report


def whole(reports: Sequence[Report]) -> str:
    """The text of the page."""
    title = _title(reports)
    budget = Budget()
    top = element("header", element("h1", title), _overview(reports))
    main = element("main", *(_report(r, n, budget) for n, r in enumerate(reports, 1)))
    metas = (
        element("meta", charset="utf-8"),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
    )
    head = element("head", *metas, element("title", title), element("style", Html(STYLE)))
    html = element("html", head, element("body", top, main), lang="en")
    return f"<!DOCTYPE html>\n{html}\n"


def _title(reports: Sequence[Report]) -> str:
    names = list(dict.fromkeys(r.head.routine for r in reports))
    return f"Conformance of {', '.join(names)}" if names else "Conformance: nothing was checked"


def _overview(reports: Sequence[Report]) -> Html:
    if len(reports) < 2:
        return Html("")
    rows = []
    for number, report in enumerate(reports, 1):
        link = element("a", report.head.title, href=f"#report-{number}")
        weights = [sum(r.severity == s for r in report.failures) for s in sections.FOUND]
        others = (len(report.of(PASS)), len(report.not_checked))
        rows.append((link, *map(str, (*weights, *others))))
    top = ("report", "failures", "warnings", "notes", "passed", "not checked or not applicable")
    return element("nav", table("Reports on this page", top, rows, class_="numbers"))


def _report(report: Report, number: int, budget: Budget) -> Html:
    prefix = f"report-{number}"
    sign, said = _outcome(report)
    sign = element("span", sign, aria_hidden="true")
    summary = paragraph(sign, f" {said} {sections.counted(report)}", class_="verdict")
    anchors = _anchors(report, prefix)
    parts = {"found": ("Findings", _failures(report, anchors, budget, prefix))}
    subject = getattr(report, "subject", None)
    if subject is not None and subject.routine is not None:
        parts["figures"] = ("What the routine does", of_routine(subject, budget, prefix))
    rules = join([sections.all_rules(report, anchors), sections.groups(report)])
    parts["rules"] = ("All rules", rules)
    notes = (paragraph(note) for note in report.notes)
    gaps = [sections.not_checked(report), *notes, _limits(subject is not None)]
    parts["gaps"] = ("What was not checked, and why", join(gaps))
    parts = {key: part for key, part in parts.items() if part[1]}
    links = [element("a", name, href=f"#{prefix}-{key}") for key, (name, _) in parts.items()]
    nav = element("nav", join(links, " \u00b7 "), aria_label="Parts of this report")
    made = [
        section(name, part, level=3, id=f"{prefix}-{key}") for key, (name, part) in parts.items()
    ]
    return section(report.head.title, summary, nav, sections.head(report), *made, id=prefix)


def _outcome(report: Report) -> tuple[str, str]:
    """Sign and sentence of the outcome."""
    if any(r.severity == "error" for r in report.failures):
        return "\u2717", "The contract is broken."
    if report.surprises:
        return "\u2717", "No errors were found, but a failure that was expected is gone."
    if not report.of(PASS) and not report.of(FAIL):
        return "?", "Nothing could be checked."
    return "\u2713", "No errors were found."


def _anchors(report: Report, prefix: str) -> dict[int, str]:
    """Identifiers of the failures by their place in the report."""
    failed = (*report.failures, *report.expected)
    return {
        index: f"{prefix}-{re.sub(r'[^a-z]+', '-', result.rule)}-{index}"
        for index, result in enumerate(report.results)
        if any(result is f for f in failed)
    }


def _failures(report: Report, anchors: dict[int, str], budget: Budget, prefix: str) -> Html:
    by_result = {id(report.results[index]): anchor for index, anchor in anchors.items()}
    subject = getattr(report, "subject", None)
    parts: list[Content] = [
        failure(result, subject, report.head.file, budget, by_result[id(result)])
        for result in (*report.failures, *report.expected)
    ]
    if report.surprises:
        rows = [(r.rule, r.requirement) for r in report.surprises]
        caption = "Expected to fail, but passed: take them from the list of expected failures"
        parts.append(table(caption, ("rule", "what has to hold"), rows))
    return join(parts)


def _limits(of_routine: bool) -> Html:
    said = (
        "A rule that passed has been tried at the cases of this run, not proved: it may still be "
        "broken at other properties, sizes and histories."
    )
    if of_routine:
        said += " That the law is the right one for the surfaces is not checked by any rule."
    return paragraph(said, class_="weak")
