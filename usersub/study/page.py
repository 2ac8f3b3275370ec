# SPDX-License-Identifier: MIT
"""One HTML page with everything that a study found; no scripts, nothing from other places."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from usersub import abi
from usersub.study import canvas, charts, figures, orders, tables, words
from usersub.study.canvas import Picture
from usersub.study.html import Html, bullets, element, facts, folded, lines, section, table
from usersub.study.pareto import Front, fronts, heading, recommendation, usable
from usersub.study.style import STYLE

if TYPE_CHECKING:
    from usersub.study.leaving_out import Saving
    from usersub.study.result import Result
    from usersub.study.stability import Cell, Limit

_MOST = 400  # rows of a table of reasons; the files have all


def write(
    path: Path,
    results: Iterable[Result],
    stamp: Mapping[str, str],
    *,
    savings: Sequence[Saving] = (),
    cells: Sequence[Cell] = (),
    limits: Sequence[Limit] = (),
    missing: Sequence[str] = (),
    title: str = "Error against run time",
) -> None:
    """Writes the page.

    Args:
        stamp: machine, versions, date: names with what belongs to them, for the head.
        savings: of `leaving_out.measure`.
        cells, limits: of the stability matrix.
        missing: what was not measured, in sentences.

    Raises:
        MissingTool: matplotlib is not installed.
        OSError: the file cannot be written.
    """
    text = page(
        results, stamp, savings=savings, cells=cells, limits=limits, missing=missing, title=title
    )
    path.write_text(text, encoding="utf-8")


def page(
    results: Iterable[Result],
    stamp: Mapping[str, str],
    *,
    savings: Sequence[Saving] = (),
    cells: Sequence[Cell] = (),
    limits: Sequence[Limit] = (),
    missing: Sequence[str] = (),
    title: str = "Error against run time",
) -> str:
    """The page as text; arguments and errors are those of `write`."""
    canvas.require()
    results = list(results)
    found = fronts(results)
    parts = [
        _recommended(found),
        *_problems(found),
        _saved(savings),
        _stability(cells),
        _limits(limits),
        _refused(found, cells),
        _missing(missing, results),
    ]
    shown = [(name, content) for name, content in parts if content]
    body = lines([
        element("h1", title),
        element("p", _summary(results, cells)),
        facts(stamp.items()),
        element("nav", bullets(
            element("a", name, href=f"#part-{k}") for k, (name, _) in enumerate(shown)
        ), aria_label="contents"),
        element("main", lines(
            section(name, content, id=f"part-{k}") for k, (name, content) in enumerate(shown)
        )),
    ])  # fmt: skip
    return _document(title, body)


def _document(title: str, body: Html) -> str:
    return "\n".join([
        "<!DOCTYPE html>",
        '<html lang="en">',
        "<head>",
        '<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        element("title", f"usersub study: {title}"),
        f"<style>{STYLE}</style>",
        "</head>",
        element("body", body),
        "</html>",
        "",
    ])  # fmt: skip


_Part = tuple[str, str]  # title and content; "" where there is nothing to tell


def _summary(results: Sequence[Result], cells: Sequence[Cell]) -> str:
    parts = []
    if results:
        ran = sum(map(usable, results))
        problems = len({result.problem for result in results})
        parts.append(f"{ran} of {len(results)} runs of {_count(problems, 'problem')} have an error")
    if cells:
        verdicts = Counter(cell.verdict for cell in cells)
        told = words.joined([f"{count} {verdict}" for verdict, count in verdicts.most_common()])
        parts.append(f"{len(cells)} stiff and extreme cases: {told}")
    return "; ".join(parts) + "." if parts else "Nothing was run."


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def figure(picture: Picture) -> Html:
    """A picture with its caption."""
    inside = element("div", Html(canvas.inline(picture)))
    caption = element("figcaption", picture.caption)
    return element("figure", inside, caption, role="img", aria_label=picture.caption)


def _recommended(found: Sequence[Front]) -> _Part:
    parts = [
        section(heading(front), bullets(recommendation(front)), level=3) for front in found
    ]  # fmt: skip
    return "Recommendation", lines(parts)


def _problems(found: Sequence[Front]) -> list[_Part]:
    """One part a problem: figures, the front, orders, all runs."""
    pictures = figures.pictures(found)
    parts: list[_Part] = []
    for front in found:
        if not front.runs:
            continue
        here = [figure(picture) for picture in pictures if picture.of is front]
        measured = table(
            "Runs that no other beats in both error and run time, fastest first.",
            tables.RUN_HEAD, tables.run_rows(front.front),
        )  # fmt: skip
        curves = orders.curves(front.runs)
        order = curves and table("Observed orders.", orders.HEAD, orders.rows(curves))
        every = (*front.runs, *(run for run in front.blocks if run not in front.runs))
        whole = folded(
            f"All {len(every)} runs",
            table("All runs, fastest first.", tables.RUN_HEAD, tables.run_rows(every)),
        )
        parts.append((heading(front), lines([*here, measured, order or "", whole])))
    return parts


def _saved(savings: Sequence[Saving]) -> _Part:
    head = (
        "interface", "language", "scene", ">ns needed", ">ns full", ">ns general",
        ">bytes needed", ">bytes full", ">bytes general", ">full/needed, time",
        ">full/needed, bytes", "same bits",
    )  # fmt: skip
    rows = [
        [s.interface.upper(), words.language(s.language), s.scene,
         *(words.number(v, 3) for v in (s.ns_needed, s.ns_full, s.ns_general)),
         *map(str, (s.bytes_needed, s.bytes_full, s.bytes_general)),
         _ratio(s.ns_full, s.ns_needed), _ratio(s.bytes_full, s.bytes_needed),
         "yes" if s.same_bits else "no"]
        for s in savings
    ]  # fmt: skip
    caption = (
        "Time and bytes of arguments of one contact point: needed with the plan, full with "
        "everything passed, general with everything passed in a scene that has everything."
    )
    measured = table(caption, head, rows) if rows else ""
    return "Leaving out", lines([*map(figure, charts.savings(savings)), measured])


def _ratio(full: float, needed: float) -> str:
    return words.number(full / needed) if needed > 0.0 else "-"


def _stability(cells: Sequence[Cell]) -> _Part:
    if not cells:
        return "Stability", ""
    found: dict[tuple[str, ...], list[Cell]] = {}
    for cell in cells:
        if cell.verdict not in ("stable", "refused"):
            key = (cell.verdict, cell.case, cell.subject, cell.interface.upper(), cell.reason)
            found.setdefault(key, []).append(cell)
    rows = [
        [*key[:4], _several(c.value for c in alike), _several(map(_how, alike)), key[4]]
        for key, alike in found.items()
    ]
    head = ("verdict", "case", "subject", "interface", "values", "languages", "what was seen")
    told = table(f"Cells that are not simply stable{_cut(rows)}.", head, rows[:_MOST])
    return "Stability", lines([*map(figure, charts.matrix(cells)), told if rows else ""])


def _several(values: Iterable[str]) -> str:
    """Different values, the first few of many."""
    different = list(dict.fromkeys(values))
    more = len(different) - 6
    return ", ".join([*different[:6], *([f"{more} more"] if more > 0 else [])])


def _how(cell: Cell) -> str:
    language = words.language(cell.language)
    return f"{language} single" if cell.precision == "single" else language


def _cut(rows: Sequence[object]) -> str:
    return f", the first {_MOST} of {len(rows)}" if len(rows) > _MOST else ""


def _limits(limits: Sequence[Limit]) -> _Part:
    rows = [
        [limit.name, limit.subject, limit.interface.upper(), limit.precision,
         words.number(limit.measured, 4), words.number(limit.theory, 4), limit.unit,
         words.number(limit.ratio, 4), limit.words]
        for limit in limits
    ]  # fmt: skip
    head = (
        "limit", "of", "interface", "precision", ">measured", ">theory", "unit", ">ratio",
        "how it was found",
    )  # fmt: skip
    measured = table("Limits beside their theory.", head, rows) if rows else ""
    return "Limits", lines([*map(figure, charts.limits(limits)), measured])


def _refused(found: Sequence[Front], cells: Sequence[Cell]) -> _Part:
    rows = tables.refused_rows(found)
    told = table(
        f"Runs that were refused{_cut(rows)}.", tables.REFUSED_HEAD, rows[:_MOST]
    )  # fmt: skip
    counted = Counter(
        (c.subject, c.interface.upper(), c.case, c.reason) for c in cells if c.verdict == "refused"
    )
    stiff = [[*key, str(count)] for key, count in counted.items()]
    head = ("subject", "interface", "case", "why", ">cells")
    extreme = table(f"Extreme cases that were refused{_cut(stiff)}.", head, stiff[:_MOST])
    return "Refused, and why", lines([told if rows else "", extreme if stiff else ""])


def _missing(missing: Sequence[str], results: Sequence[Result]) -> _Part:
    """What the study did not look at: what it was told, and what shows in the results."""
    noticed = list(missing)
    axes = (
        (
            "interfaces",
            {r.interface.upper() for r in results},
            [name.upper() for name in abi.NAMES],
        ),
        ("languages", {words.language(r.language) for r in results}, ("C", "Fortran", "Python")),
        ("precisions", {r.precision for r in results}, ("double", "single")),
    )
    for name, seen, known in axes if results else ():
        absent = [value for value in known if value not in seen]
        if absent:
            noticed.append(f"No runs of these {name}: {words.joined(absent)}.")
    if results and all(result.block is None for result in results):
        noticed.append("The number of contact points of a call was not varied.")
    return "Not measured", bullets(noticed) if noticed else ""
