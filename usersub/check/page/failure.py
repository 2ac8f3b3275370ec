# SPDX-License-Identifier: MIT
"""One failure on the page: all that a newcomer needs to see what to change."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from usersub.check.page import source
from usersub.check.page.html import Content, Html, code, element, join, listing, paragraph, table
from usersub.check.page.pictures import of_case
from usersub.check.page.sections import verdict

if TYPE_CHECKING:
    from usersub.check.page.safely import Budget
    from usersub.check.reports.report import Result
    from usersub.check.subject import Subject

_MOST = 12  # numbers of a finding that are listed in one row


def failure(
    result: Result, subject: Subject | None, file: str, budget: Budget, anchor: str
) -> Html:
    """Requirement, what was found, case, place, what to do, how to see it again."""
    parts: list[Content] = [
        element("h4", verdict(result), ": ", code(result.rule)),
        paragraph(result.requirement),
        element("h5", "What was found"),
        paragraph(result.detail, class_="found"),
    ]
    if result.hint:
        parts += [element("h5", "What to change"), paragraph(result.hint)]
    if result.where:
        parts += _place(result, file)
    if result.case is not None:
        parts += [element("h5", "Smallest case"), listing(result.words, "Smallest case in words")]
        if subject is not None and subject.routine is not None:
            parts.append(of_case(subject, result, budget, anchor))
    parts.append(_numbers(result.figures))
    if result.output.strip():
        parts += [
            element("h5", "What it wrote"),
            listing(result.output.strip(), "What the routine wrote"),
        ]
    if result.reproduction:
        parts += [element("h5", "See it again"), listing(result.reproduction, "Reproduction")]
    if result.reference:
        parts.append(paragraph(f"Why it has to hold: {result.reference}", class_="weak"))
    weak = result.expected or result.severity == "note"
    return element("article", join(parts), class_="failure light" if weak else "failure", id=anchor)


def _place(result: Result, file: str) -> list[Content]:
    lines = source.excerpt(result.where, file)
    parts: list[Content] = [element("h5", "Where"), paragraph(code(result.where))]
    if lines:
        parts.append(listing(lines, f"Source around {result.where}", "source"))
    return parts


def _numbers(figures: dict[str, Any]) -> Html:
    """Numbers of a finding that say more than the place in the case."""
    rows = [
        (name.replace("_", " "), _in_words(value))
        for name, value in figures.items()
        if name not in ("step", "point")
    ]
    return table("Numbers of this finding", ("name", "value"), rows) if rows else Html("")


def _in_words(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list | tuple):
        shown = ", ".join(_in_words(v) for v in value[:_MOST])
        more = f", ... ({len(value)} in all)" if len(value) > _MOST else ""
        return f"({shown}{more})"
    return str(value)
