# SPDX-License-Identifier: MIT
"""`usersub study --compare`: whether another study says the same."""

from __future__ import annotations

import csv
import json
from collections import Counter
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from usersub.cli.output import print_table, relative
from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.cli.study_output import Found
    from usersub.study.comparing import Conclusion
    from usersub.study.result import Result

_FILE = "comparison.csv"
_COLUMNS = ("about", "what", "here", "there", "verdict")


@dataclass(frozen=True)
class Other:
    """What the other folder has."""

    folder: Path
    results: list[Result]
    extremes: dict[str, list[dict[str, Any]]]


@dataclass(frozen=True)
class Comparison:
    """Conclusions of two studies.

    Attributes:
        folder: of the other study.
        conclusions: of what both have.
        only: points of one study alone: here, there.
    """

    folder: Path
    conclusions: list[Conclusion]
    only: tuple[int, int]

    @property
    def agrees(self) -> bool:
        """Whether no conclusion differs."""
        return all(conclusion.verdict != "differs" for conclusion in self.conclusions)

    def show(self) -> None:
        """Those that differ, those that only the clock has changed, and how many there are."""
        told = [c for c in self.conclusions if c.verdict != "same"]
        told.sort(key=lambda c: c.verdict != "differs")
        if told:
            print_table(f"Compared with {relative(self.folder)}", _COLUMNS,
                        [tuple(asdict(c).values()) for c in told], wrap=_COLUMNS[:4])  # fmt: skip
        counts = Counter(c.verdict for c in self.conclusions)
        click.echo(
            f"compared with {relative(self.folder)}: {len(self.conclusions)} conclusions, "
            f"{counts['same']} are the same, {counts['as fast']} differ within what the clock "
            f"tells apart, {counts['differs']} differ; all of them: {_FILE}"
        )
        for count, where in zip(self.only, ("here", "there"), strict=True):
            if count:
                click.echo(f"not compared: {count} points that are only {where}")


def other(folder: Path | None) -> Other | None:
    """What is in the folder of --compare, or None without one.

    Raises:
        SceneError: it holds no finished study.
    """
    from usersub.study import extremes
    from usersub.study.result import Result

    if folder is None:
        return None
    results = folder / "results.json"
    if not results.is_file() and not (folder / extremes.NAME).is_file():
        raise SceneError(f"--compare is {folder}, which holds no finished study")
    try:
        rows = json.loads(results.read_text(encoding="utf-8")) if results.is_file() else {}
        return Other(folder, [Result.of(row) for row in rows.get("results", [])],
                     extremes.read(folder))  # fmt: skip
    except (ValueError, KeyError, TypeError) as error:
        raise SceneError(f"--compare is {folder}, whose files cannot be read: {error}") from error


def compared(found: Found, there: Other, folder: Path) -> Comparison:
    """Compares, and writes all conclusions into the folder.

    Raises:
        SceneError: there is nothing that both studies have.
    """
    from usersub.study import comparing

    parts = {"cells": found.cells, "limits": found.limits, "savings": found.savings}
    here = {name: [vars(row) for row in rows] for name, rows in parts.items()}
    conclusions = [
        *comparing.compare(found.results, there.results),
        *comparing.compare_extremes(here, there.extremes),
    ]
    if not conclusions:
        raise SceneError(f"--compare is {there.folder}, which has no point of this study")
    with (folder / _FILE).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, _COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(map(asdict, conclusions))
    only = comparing.unmatched(found.results, there.results)
    return Comparison(there.folder, conclusions, only)
