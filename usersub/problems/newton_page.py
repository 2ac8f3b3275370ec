# SPDX-License-Identifier: MIT
"""The documentation's page about Newton's method: prose from `newton.md.in`, numbers from runs."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from usersub.problems.newton import Run
from usersub.problems.newton_host import MOST_ITERATIONS
from usersub.problems.page import error, table

_TEMPLATE = Path(__file__).with_name("newton.md.in")

_HEADS = "enforcement, coefficient, >slip, >residuals, >order, >iterations, >symmetric: order"
_HEADS += ", >iterations"


def page(runs: Iterable[Run], stamp: str) -> str:
    """The page in Markdown.

    Args:
        stamp: what the numbers were made with.
    """
    by_host: dict[str, list[Run]] = {}
    for run in runs:
        by_host.setdefault(f"TABLE_{run.points}_{run.directions}", []).append(run)
    values = {"STAMP": stamp, "MOST": str(MOST_ITERATIONS)}
    values |= {name: table(_HEADS, map(row, found)) for name, found in by_host.items()}
    sentences = [r.sentence for found in by_host.values() for r in found if r.anisotropic]
    values["SENTENCE"] = sentences[-1]
    text = _TEMPLATE.read_text(encoding="utf-8")
    return re.sub(r"@(\w+)@", lambda match: values[match[1]], text)


def row(run: Run) -> list[object]:
    """The cells of a run, as they stand on the page."""
    residuals = " ".join(error(x) for x in run.residuals)
    number = len(run.residuals)
    never = f"not in {MOST_ITERATIONS}"
    return [
        run.method, law(run), f"{run.slipping} of {run.points}", residuals, _order(run.order),
        number, _order(run.symmetric_order), run.symmetric or never,
    ]  # fmt: skip


def law(run: Run) -> str:
    """The law of a run in words."""
    return run.law + (", two" if run.anisotropic else "")


def _order(order: float | None) -> str:
    return "exact" if order is None else f"{order:.2f}"
