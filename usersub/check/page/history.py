# SPDX-License-Identifier: MIT
"""A failing case as a drawing: what the host did, and what the routine answered."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.page.canvas import OFFENDER, decimal, line
from usersub.check.page.figures import Data
from usersub.check.page.names import friction_name, load_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from usersub.check.case import Case
    from usersub.check.subject import Subject

_LARGEST = 1e100  # of what is drawn: axes cannot hold much more
_SHOWN = 9  # points that are drawn


@dataclass(frozen=True)
class Mark:
    """The increment and point at which a fault shows, from 0.

    Attributes:
        step, point: the increment and the point.
        sure: the rule named them; otherwise the fault shows by the end of `step`.
        points: number of points of the case.
    """

    step: int
    point: int
    sure: bool
    points: int = 1

    def words(self, what: str) -> str:
        """What the mark in the drawing means; `what` shows there, "the fault" for example."""
        if not self.sure:
            return f"marked: increment {self.step + 1}, by which {what} shows"
        which = f", point {self.point + 1} of {self.points}" if self.points > 1 else ""
        return f"marked: {what}, increment {self.step + 1}{which}"


def mark_of(case: Case, figures: dict[str, Any]) -> Mark:
    """Where the fault shows, by the rule's figures; else the end of the case."""
    last = len(case.steps) - 1
    step, point = figures.get("step"), figures.get("point")
    if isinstance(step, int) and 0 <= step <= last:
        known = isinstance(point, int) and 0 <= point < case.points
        if known or case.points == 1:
            return Mark(step, point if known else 0, True, case.points)  # type: ignore[arg-type]
    return Mark(last, 0, False, case.points)


def answers(subject: Subject, case: Case) -> Iterator[Data]:
    """Response of every increment, until the routine fails."""
    from usersub.check.respond import run_of

    run = run_of(subject, case)
    for index in range(len(case.steps)):
        answer = run.step(index)
        values = answer.coefficient if answer.friction is None else answer.friction
        yield {"response": np.atleast_2d(np.array(values, dtype=float)).tolist()}


def draw(subject: Subject, case: Case, found: tuple[Data, ...], mark: Mark) -> Any:
    """Draws motion, load and response."""

    def drawing(figure: Figure) -> None:
        left, middle, right = figure.subplots(1, 3, width_ratios=(1.1, 1.0, 1.2))
        _motion(left, case, mark)
        _over_increments(middle, case, [[list(s.load)] for s in case.steps], mark)
        middle.set_ylabel(load_name(subject))
        if any(s.stick is not None for s in case.steps):
            _stick_force(middle, case, mark)
        response = [piece["response"] for piece in found]
        _over_increments(right, case, response, mark)
        right.set_ylabel(friction_name(subject))
        if len(response) < len(case.steps):
            _broken(right, len(response) + 1)

    return drawing


def _stick_force(axes: Axes, case: Case, mark: Mark) -> None:
    """The stick force of the point of the fault beside its load, where the case gives one."""
    held = [np.nan if s.stick is None else s.stick[mark.point] for s in case.steps]
    x, y = np.arange(1, len(held) + 1), _drawable(np.array(held))
    axes.plot([], [], label="load", **line(0))
    axes.plot(x, y, marker="s", markersize=4, label="stick force", **line(2))
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)


def _motion(axes: Axes, case: Case, mark: Mark) -> None:
    with np.errstate(over="ignore", invalid="ignore"):
        steps = np.array([s.motion for s in case.steps], dtype=float)  # (steps, N, F)
        path = np.concatenate([np.zeros((1, *steps.shape[1:])), np.cumsum(steps, axis=0)])
    path = _drawable(path)
    if case.directions == 1:
        _lines(axes, np.arange(len(path)), path[:, :, 0], mark, case)
        axes.plot(mark.step + 1, path[mark.step + 1, mark.point, 0], **OFFENDER)
        axes.set_xlabel("increment")
        axes.set_ylabel("motion [length]")
        _whole_ticks(axes, len(case.steps))
        return
    for point in range(min(case.points, _SHOWN)):
        x, y = path[:, point].T
        axes.plot(x, y, marker=".", **_of_point(point, mark, case))
    x, y = path[:, mark.point].T
    _numbered(axes, x, y)
    axes.plot(x[mark.step + 1], y[mark.step + 1], **OFFENDER)
    axes.set_xlabel("motion, direction 1 [length]")
    axes.set_ylabel("motion, direction 2 [length]")
    decimal(axes, "x")
    decimal(axes, "y")
    _room(axes, path)


def _numbered(axes: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """Numbers of the increments at the places that they lead to, one label a place."""
    labels: dict[tuple[float, float], list[str]] = {}
    for index, place in enumerate(zip(x.tolist(), y.tolist(), strict=True)):
        labels.setdefault(place, []).append("start" if index == 0 else str(index))
    for place, names in labels.items():
        if np.isfinite(place).all():
            axes.annotate(
                ", ".join(names), place, xytext=(7, 6), textcoords="offset points", fontsize=8,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
                zorder=6,
            )  # fmt: skip


def _room(axes: Axes, path: np.ndarray) -> None:
    """Limits of equal length, so that a straight path lies in the middle of its picture."""
    finite = path[np.isfinite(path).all(axis=2)]
    low, high = (finite.min(axis=0), finite.max(axis=0)) if len(finite) else (np.zeros(2),) * 2
    half = 0.65 * max(float((high - low).max()), 1e-99)
    if float((high - low).max()) == 0.0:
        half = 1.0
    x, y = 0.5 * (low + high)
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(y - half, y + half)


def _over_increments(axes: Axes, case: Case, rows: list[Any], mark: Mark) -> None:
    """Values (steps, components, points) over the increments."""
    axes.set_xlabel("increment")
    _whole_ticks(axes, len(case.steps))
    axes.axvspan(mark.step + 0.75, mark.step + 1.25, color="#d55e00", alpha=0.15, lw=0)
    if not rows:
        return
    raw = np.array(rows, dtype=float)
    values, x = _drawable(raw), np.arange(1, len(raw) + 1)
    for component in range(values.shape[1]):
        style = line(component)
        label = f"direction {component + 1}" if values.shape[1] > 1 else None
        _lines(axes, x, values[:, component], mark, case, style, label)
        if mark.step < len(values):
            axes.plot(mark.step + 1, values[mark.step, component, mark.point], **OFFENDER)
    _missing(axes, x, values)
    if values.shape[1] > 1:
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)
    axes.margins(y=0.15)
    finite = values[np.isfinite(values)]
    if finite.size and finite.min() == finite.max() == 0.0:
        axes.set_ylim(-1.0, 1.0)
    decimal(axes, "y")


def _lines(
    axes: Axes,
    x: np.ndarray,
    values: np.ndarray,
    mark: Mark,
    case: Case,
    style: dict[str, Any] | None = None,
    label: str | None = None,
) -> None:
    for point in range(min(case.points, _SHOWN)):
        own = _of_point(point, mark, case, style)
        axes.plot(
            x, values[:, point], marker=".", label=label if point == mark.point else None, **own
        )


def _of_point(
    point: int, mark: Mark, case: Case, style: dict[str, Any] | None = None
) -> dict[str, Any]:
    """The point of the fault as a strong line, the others as thin grey ones."""
    style = style or line(0)
    if point == mark.point or (not mark.sure and case.points == 1):
        return {**style, "zorder": 4}
    return {**style, "color": "0.65", "linewidth": 0.9, "zorder": 3}


def _drawable(values: np.ndarray) -> np.ndarray:
    with np.errstate(invalid="ignore"):
        return np.where(np.abs(values) <= _LARGEST, values, np.nan)


def _missing(axes: Axes, x: np.ndarray, values: np.ndarray) -> None:
    """Crosses at the upper edge where a value is no number that can be drawn."""
    gone = x[~np.isfinite(values).all(axis=(1, 2))]
    if gone.size:
        _crosses(axes, gone, "not a finite number")


def _broken(axes: Axes, increment: int) -> None:
    _crosses(axes, np.array([increment]), "no answer")


def _crosses(axes: Axes, x: np.ndarray, words: str) -> None:
    where = axes.get_xaxis_transform()
    axes.plot(x, np.full(x.size, 0.92), "x", ms=9, mew=2.2, color="#d55e00", transform=where)
    right = x[0] > 0.5 * sum(axes.get_xlim())
    axes.annotate(
        words, (x[0], 0.92), xycoords=where, xytext=(-8 if right else 8, 0), va="center",
        textcoords="offset points", ha="right" if right else "left", fontsize=8,
    )  # fmt: skip


def _whole_ticks(axes: Axes, count: int) -> None:
    from matplotlib.ticker import MaxNLocator

    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True, min_n_ticks=1))
    axes.set_xlim(-0.1 if count > 1 else 0.0, count + 0.4)
