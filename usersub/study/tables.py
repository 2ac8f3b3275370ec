# SPDX-License-Identifier: MIT
"""Results as tables: CSV and JSON for programs, rows for pages."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from usersub.problems.problem import KEYS
from usersub.study.words import language, method, number, refinement, seconds

if TYPE_CHECKING:
    from usersub.study.pareto import Front
    from usersub.study.result import Result

#: Columns of a result: those of every problem, spread, and what else was chosen or went wrong.
COLUMNS = (
    *KEYS, "run_time_low", "run_time_high", "repeats", "increments", "block", "options", "routine",
    "refined", "reference", "tolerance", "refused", "key",
)  # fmt: skip


def row(result: Result) -> dict[str, object]:
    """A result by `COLUMNS`; what is not finite is None."""
    return {name: _plain(getattr(result, name)) for name in COLUMNS}


def _plain(value: object) -> object:
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return dict(value) if isinstance(value, tuple) else value


def csv_text(results: Iterable[Result]) -> str:
    """Comma-separated values under `COLUMNS`; numbers can be read back to the last bit."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for result in results:
        writer.writerow({name: _flat(value) for name, value in row(result).items()})
    return text.getvalue()


def _flat(value: object) -> object:
    """A value in one cell; options as `name=value` with semicolons between."""
    if isinstance(value, dict):
        return "; ".join(f"{name}={option}" for name, option in value.items())
    return "" if value is None else value


def json_text(results: Iterable[Result], stamp: Mapping[str, str] | None = None) -> str:
    """One JSON object with `stamp` and `results`; what is not finite is null."""
    whole = {"stamp": dict(stamp or {}), "results": [row(result) for result in results]}
    return json.dumps(whole, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def markdown(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A Markdown table; heads that begin with `>` have numbers below, aligned to the right."""
    lines = [
        _line(name.lstrip(">") for name in head),
        _line("---:" if name.startswith(">") else "---" for name in head),
    ]
    return "\n".join([*lines, *(_line(map(_cell, cells)) for cells in rows)])


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cell(value: object) -> str:
    return " ".join(str(value).split()).replace("|", "\\|")


#: Heads of `run_rows`.
RUN_HEAD = (
    "interface", "language", "method", "precision", ">refinement", ">points a call", ">error",
    ">run time", ">quartiles",
)  # fmt: skip


def run_rows(runs: Iterable[Result]) -> list[list[str]]:
    """Runs for people."""
    return [
        [run.interface.upper(), language(run.language), method(run), run.precision,
         refinement(run), str(run.points), number(run.error), seconds(run.run_time_s),
         quartiles(run)]
        for run in runs
    ]  # fmt: skip


def quartiles(run: Result) -> str:
    """First and third quartile of the run time; a dash where it was taken once."""
    if math.isnan(run.run_time_low) or math.isnan(run.run_time_high):
        return "-"
    return f"{seconds(run.run_time_low)} to {seconds(run.run_time_high)}"


#: Heads of `refused_rows`.
REFUSED_HEAD = ("problem", "law", "interface", "language", "method", "why", ">points")


def refused_rows(fronts: Iterable[Front]) -> list[list[str]]:
    """What was refused and why; points that differ in step, block or precision share a row."""
    counted: dict[tuple[str, ...], int] = {}
    for front in fronts:
        for run in front.refused:
            why = run.refused or "the error is not a finite number"
            key = (run.problem, run.law, run.interface.upper(), language(run.language),
                   method(run), why)  # fmt: skip
            counted[key] = counted.get(key, 0) + 1
    return [[*key, str(count)] for key, count in counted.items()]
