# SPDX-License-Identifier: MIT
"""What `usersub study` prints."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from usersub.cli.output import number, print_json, print_table, relative

if TYPE_CHECKING:
    from usersub.cli.study_comparison import Comparison
    from usersub.study import Result, Study


@dataclass
class Found:
    """The parts of a study; empty where they were not asked for."""

    study: Study | None = None
    cells: list[Any] = field(default_factory=list)
    limits: list[Any] = field(default_factory=list)
    savings: list[Any] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)
    comparison: Comparison | None = None

    @property
    def results(self) -> list[Result]:
        return self.study.results if self.study else []

    @property
    def stamp(self) -> dict[str, str]:
        from usersub.study.stamp import stamp

        return self.study.stamp if self.study else stamp()


def print_found_json(found: Found) -> None:
    """One object; `results` are those of error against run time."""
    from usersub.study import pareto, tables

    rows = [{**tables.row(result), "says": result.says} for result in found.results]
    told = [{"about": t, "sentences": s} for t, s in pareto.recommendations(found.results)]
    print_json(
        "study", rows, stamp=found.stamp, recommendations=told,
        unfinished=found.study.unfinished if found.study else 0,
        cells=[vars(cell) for cell in found.cells], limits=[vars(x) for x in found.limits],
        savings=[vars(saving) for saving in found.savings], missing=found.missing,
        files=[str(file) for file in found.files],
        comparison=[vars(c) for c in found.comparison.conclusions] if found.comparison else [],
    )  # fmt: skip


def print_found(found: Found, folder: Path) -> None:
    """The Pareto front of each problem, what to use, savings, extremes, and where all of it is."""
    if found.results:
        _print_fronts(found.results)
    tables = (_savings_table, found.savings), (_cells_table, found.cells), (_limits, found.limits)
    for table, rows in tables:
        if rows:
            table(rows)
    for sentence in found.missing:
        click.echo(f"left out: {sentence}")
    study = found.study
    if study is not None:
        kept = f", {study.kept} were there" if study.kept else ""
        ran = f"{_counted(len(found.results))}, {study.ran} runs{kept}"
        click.echo(f"{ran}; {_stamped(found.stamp)}")
        if study.unfinished:
            click.echo(
                f"interrupted: {_counted(study.unfinished)} "
                f"{'is' if study.unfinished == 1 else 'are'} not finished. What was run is kept in "
                f"{relative(folder)}; the same command goes on"
            )
            return
    if found.comparison is not None:
        found.comparison.show()
    pages = [file for file in found.files if file.suffix == ".html"]
    click.echo(f"results: {relative(folder)}" + "".join(f", page: {relative(p)}" for p in pages))


def _counted(count: int) -> str:
    return f"{count} point{'' if count == 1 else 's'}"


def _stamped(stamp: dict[str, str]) -> str:
    return ", ".join(v if k == "machine" else f"{k} {v}" for k, v in stamp.items())


def _print_fronts(results: list[Result]) -> None:
    from usersub.study import pareto, tables

    heads = [head.lstrip(">") for head in tables.RUN_HEAD]
    right = [head.lstrip(">") for head in tables.RUN_HEAD if head.startswith(">")]
    for front in pareto.fronts(results):
        print_table(pareto.heading(front), heads, tables.run_rows(front.front), right=right,
                    optional=("quartiles", "points a call", "precision"))  # fmt: skip
        for sentence in pareto.recommendation(front):
            click.echo(sentence)
        for says in dict.fromkeys(run.says for run in front.front if run.says):
            click.echo(f"answer: {says}")
        for reason in dict.fromkeys(r.refused for r in front.refused if r.refused):
            count = sum(r.refused == reason for r in front.refused)
            click.echo(f"refused, {_counted(count)}: {reason}")
        click.echo()


def _savings_table(savings: list[Any]) -> None:
    rows = [
        (s.scene, s.interface.upper(), number(s.ns_needed, 3), number(s.ns_full, 3),
         number(s.ns_full / s.ns_needed, 3), number(s.bytes_needed, 4), number(s.bytes_full, 4))
        for s in savings
    ]  # fmt: skip
    columns = ("scene", "interface", "ns/point", "everything passed", "ratio", "bytes/point",
               "everything passed ")  # fmt: skip
    print_table("What is left out", columns, rows, right=columns[2:], wrap=("scene",))


def _cells_table(cells: list[Any]) -> None:
    """How many cells of each subject are stable, and every one that is not told otherwise."""
    verdicts = ("stable", "bounded", "refused", "fails")
    counts = Counter((c.subject, c.interface, c.verdict) for c in cells)
    rows = [
        (subject, interface.upper(), *(str(counts[subject, interface, v]) for v in verdicts))
        for subject, interface in dict.fromkeys((c.subject, c.interface) for c in cells)
    ]
    print_table("Stiff and extreme cases", ("subject", "interface", *verdicts), rows,
                right=verdicts)  # fmt: skip
    for cell in cells:
        if cell.verdict == "fails":
            click.echo(f"fails: {cell.case}, {cell.interface.upper()}: {cell.reason}")


def _limits(limits: list[Any]) -> None:
    rows = [
        (x.name, x.subject, x.interface.upper(), x.precision, number(x.measured, 4),
         "-" if x.theory is None else number(x.theory, 4), x.unit)
        for x in limits
    ]  # fmt: skip
    columns = ("limit", "subject", "interface", "precision", "measured", "theory", "unit")
    print_table("Limits", columns, rows, right=columns[4:6], wrap=columns[:2])
