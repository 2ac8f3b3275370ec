# SPDX-License-Identifier: MIT
"""Orders of convergence as observed: how the error falls when a run is refined."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING

from usersub.study import words

if TYPE_CHECKING:
    from usersub.study.result import Result

#: Errors below are rounding, which tells no order.
ROUNDING = {"double": 1e-13, "single": 3e-6}


@dataclass(frozen=True)
class Curve:
    """Errors of one method through one interface, the worst of languages and blocks.

    Attributes:
        method: with its options, in words.
        against: what is refined, with its unit.
        runs: one a size, coarse to fine.
        order: observed, or None where too few errors stand out of rounding.
    """

    problem: str
    law: str
    interface: str
    method: str
    precision: str
    error_of: str
    against: str
    runs: tuple[Result, ...]
    order: float | None


def curves(runs: Iterable[Result]) -> list[Curve]:
    """The curves of runs that have an error; those with one size are left out."""
    found: dict[tuple[str, ...], dict[float, Result]] = {}
    for run in runs:
        if run.increments is None or not size(run) > 0.0:
            continue
        key = (
            run.problem, run.law, run.interface, words.method(run), run.precision, run.error_of,
            against(run),
        )  # fmt: skip
        sizes = found.setdefault(key, {})
        if size(run) not in sizes or run.error > sizes[size(run)].error:
            sizes[size(run)] = run
    return [_curve(sizes) for sizes in found.values() if len(sizes) > 1]


def _curve(sizes: dict[float, Result]) -> Curve:
    runs = tuple(sizes[s] for s in sorted(sizes, reverse=True))
    one = runs[0]
    return Curve(
        one.problem, one.law, one.interface, words.method(one), one.precision, one.error_of,
        against(one), runs, _order(sizes, one.precision),
    )  # fmt: skip


def size(run: Result) -> float:
    """What goes to zero in refinement: the time increment, or one over the number of points."""
    return run.step if words.by_time(run) else 1.0 / (run.increments or 1)


def against(run: Result) -> str:
    """What `size` is, with its unit."""
    return "time increment [s]" if words.by_time(run) else f"1 / {run.refined} [-]"


def _order(sizes: dict[float, Result], precision: str) -> float | None:
    floor = ROUNDING.get(precision, ROUNDING["double"])
    return slope([(h, run.error) for h, run in sizes.items() if run.error > floor])


def slope(pairs: Sequence[tuple[float, float]]) -> float | None:
    """Slope in logarithms: the median over all pairs of points, so that one outlier tells nothing.

    None of fewer than two points.
    """
    if len(pairs) < 2:
        return None
    logs = [(math.log(x), math.log(y)) for x, y in pairs]
    slopes = [
        (b[1] - a[1]) / (b[0] - a[0]) for k, a in enumerate(logs) for b in logs[k + 1 :]
    ]  # fmt: skip
    return median(slopes)


#: Heads of `rows`.
HEAD = (
    "problem", "law", "interface", "method", "precision", "against", ">coarsest", ">finest",
    ">runs", ">error at the finest", ">order",
)  # fmt: skip


def rows(found: Iterable[Curve]) -> list[list[str]]:
    """The curves for people."""
    return [
        [c.problem, c.law, c.interface.upper(), c.method, c.precision, c.against,
         words.number(size(c.runs[0])), words.number(size(c.runs[-1])), str(len(c.runs)),
         words.number(c.runs[-1].error), order_words(c)]
        for c in found
    ]  # fmt: skip


def order_words(curve: Curve) -> str:
    """The order, or why there is none."""
    if curve.order is not None:
        return f"{curve.order:.1f}".replace("-0.0", "0.0")
    floor = ROUNDING.get(curve.precision, ROUNDING["double"])
    return "rounding" if all(run.error <= floor for run in curve.runs) else "-"
