# SPDX-License-Identifier: MIT
"""Diagrams of many lines: one panel an interface, the same axes in all, one legend."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.study import canvas, words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from usersub.study.result import Result


@dataclass(frozen=True)
class Kind:
    """One kind of diagram.

    Attributes:
        x, y: of a run.
        x_label, y_label: of the axes.
        methods: all of the problem, in the order of their markers.
        line: runs of which this is the same are joined.
        languages: whether these are told apart by dashes.
        spread: whether the quartiles of the run time are drawn.
        behind: draws into a panel, below the lines.
        labels: of methods in the legend, if they are not their names.
        more: further entries of the legend.
    """

    x: Callable[[Result], float]
    y: Callable[[Result], float]
    x_label: str
    y_label: str
    methods: Sequence[str]
    line: Callable[[Result], object]
    languages: bool = True
    spread: bool = False
    behind: Callable[[Axes, Sequence[Result]], None] | None = None
    labels: Callable[[str], str] = str
    more: Callable[[], list[tuple[Any, str]]] = list


def size(runs: Sequence[Result], kind: Kind) -> tuple[float, float]:
    """Width and height of the diagram of these runs, in inches."""
    rows, columns = _shape(len(_interfaces(runs)))
    below = _legend_of(runs, kind).rows
    width = canvas.COLUMN if columns == 1 else canvas.PAGE
    return width, 0.5 + 2.15 * rows + (0.55 if columns == 1 else 0.0) + 0.17 * below


def draw(figure: Figure, runs: Sequence[Result], kind: Kind, title: str) -> None:
    """Draws the runs."""
    interfaces = _interfaces(runs)
    rows, columns = _shape(len(interfaces))
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes in grid.flat:
        axes.set_xscale("log")
        axes.set_yscale("log")
    _limits(grid[0, 0], runs, kind)
    for axes, interface in zip(grid.flat, interfaces, strict=False):
        here = [run for run in runs if run.interface == interface]
        if kind.behind:
            kind.behind(axes, here)
        for line in _lines(here, kind):
            _line(axes, line, kind)
        axes.set_title(interface.upper())
    figure.suptitle(_wrapped(title, 46 if columns == 1 else 96))
    _axes_labels(grid, len(interfaces), kind)
    _legend(figure, grid, len(interfaces), _legend_of(runs, kind))


def _wrapped(title: str, most: int) -> str:
    """In lines; what stands in brackets begins a line."""
    head, _, rest = title.partition(" (")
    if len(title) <= most or not rest:
        return textwrap.fill(title, most)
    return f"{textwrap.fill(head, most)}\n{textwrap.fill(rest.removesuffix(')'), most)}"


def _interfaces(runs: Sequence[Result]) -> list[str]:
    return list(dict.fromkeys(run.interface for run in sorted(runs, key=lambda r: r.interface)))


def _shape(panels: int) -> tuple[int, int]:
    """Rows and columns."""
    columns = {1: 1, 2: 2, 4: 2}.get(panels, 3)
    return math.ceil(panels / columns), columns


def _lines(runs: Sequence[Result], kind: Kind) -> list[list[Result]]:
    found: dict[object, list[Result]] = {}
    for run in runs:
        found.setdefault(kind.line(run), []).append(run)
    return [
        sorted(line, key=lambda r: (r.increments or 0, r.block or 0)) for line in found.values()
    ]


def _line(axes: Axes, line: Sequence[Result], kind: Kind) -> None:
    first = line[0]
    x, y = np.array([kind.x(run) for run in line]), np.array([kind.y(run) for run in line])
    style = _style(kind.methods.index(words.method(first)), first.precision)
    style["linestyle"] = _dash(first.language) if kind.languages else "-"
    if kind.spread:
        low, high = (
            np.array([getattr(run, f"run_time_{end}") for run in line]) for end in ("low", "high")
        )
        bars = np.nan_to_num(np.clip([x - low, high - x], 0.0, None))
        axes.errorbar(
            x, y, xerr=bars, fmt="none", ecolor=style["color"], elinewidth=0.8, capsize=1.8,
            zorder=2,
        )  # fmt: skip
    axes.plot(x, y, zorder=3, **style)


#: Of the markers of the first methods, so that one below another is seen around it.
_SIZES = (6.0, 4.6, 3.2)


def _style(index: int, precision: str) -> dict[str, Any]:
    marker, color = canvas.MARKS[index % len(canvas.MARKS)]
    face = "white" if precision == "single" else color
    style: dict[str, Any] = {
        "marker": marker, "color": color, "markerfacecolor": face, "markeredgewidth": 0.9,
        "markersize": _SIZES[min(index, len(_SIZES) - 1)],
    }  # fmt: skip
    if index >= len(canvas.MARKS):  # the same markers again, half of each filled
        style |= {"fillstyle": "bottom", "markerfacecoloralt": "0.8"}
    return style


def _dash(language: str) -> Any:
    return canvas.DASHES.get(language, canvas.OTHER_DASH)


def _limits(axes: Axes, runs: Sequence[Result], kind: Kind) -> None:
    """Axes of whole decades where there would be less than two numbers on them."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    for value, axis, limit in (
        (kind.x, axes.xaxis, axes.set_xlim), (kind.y, axes.yaxis, axes.set_ylim),
    ):  # fmt: skip
        found = [v for v in map(value, runs) if 0.0 < v < math.inf]
        low, high = math.log10(min(found)), math.log10(max(found))
        room = 0.06 * max(high - low, 1.0)
        low, high = low - room, high + room
        if high - low < 2.2:
            low, high = min(low, math.floor(low + room)), max(high, math.ceil(high - room))
        limit(10.0**low, 10.0**high)
        axis.set_major_locator(LogLocator(numticks=6))
        if low > -2.5 and high < 5.0:
            axis.set_major_formatter(FuncFormatter(lambda number, _: f"{number:g}"))
        axis.set_minor_formatter(NullFormatter())


def _axes_labels(grid: np.ndarray, panels: int, kind: Kind) -> None:
    rows, columns = grid.shape
    for index, axes in enumerate(grid.flat):
        if index >= panels:
            axes.axis("off")
            continue
        if index + columns >= panels:  # nothing below
            axes.set_xlabel(kind.x_label)
            axes.tick_params(labelbottom=True)
        if index % columns == 0:
            axes.set_ylabel(kind.y_label)


def _methods_of(runs: Sequence[Result], kind: Kind) -> list[tuple[Any, str]]:
    """Entries of the legend: methods."""
    from matplotlib.lines import Line2D

    line: Any = "none" if kind.languages else "-"
    shown = {words.method(run) for run in runs}
    return [
        (Line2D([], [], linestyle=line, **_style(index, "")), kind.labels(method))
        for index, method in enumerate(kind.methods)
        if method in shown
    ]


def _others_of(runs: Sequence[Result], kind: Kind) -> list[tuple[Any, str]]:
    """Entries of the legend: languages, precision, and what else there is."""
    from matplotlib.lines import Line2D

    entries: list[tuple[Any, str]] = []
    languages = sorted({run.language for run in runs}) if kind.languages else []
    for language in languages:
        dash = Line2D([], [], color="black", linestyle=_dash(language))
        entries.append((dash, words.language(language)))
    if "single" in {run.precision for run in runs}:
        empty = Line2D([], [], linestyle="none", **{**_style(0, "single"), "color": "black"})
        entries.append((empty, "empty: single precision"))
    return [*entries, *kind.more()]


@dataclass(frozen=True)
class _Legend:
    """Where the legend stands and how.

    Attributes:
        entries: filled up with empty ones, so that a column holds methods or others.
        columns: of the legend; 0 if it stands in the place of a panel that is not there.
    """

    entries: list[tuple[Any, str]]
    columns: int

    @property
    def rows(self) -> int:
        """Below the panels."""
        return math.ceil(len(self.entries) / self.columns) if self.columns else 0


def _legend_of(runs: Sequence[Result], kind: Kind) -> _Legend:
    from matplotlib.lines import Line2D

    methods, others = _methods_of(runs, kind), _others_of(runs, kind)
    rows, columns = _shape(panels := len(_interfaces(runs)))
    longest = max(len(label) for _, label in methods + others)
    if rows * columns > panels and len(methods + others) <= 12 and longest <= 29:
        return _Legend(methods + others, 0)
    most = max(1, min(4, (50 if columns == 1 else 106) // (longest + 8)))
    high = even = math.ceil(len(methods + others) / most)
    while most > 1 and math.ceil(len(methods) / high) + math.ceil(len(others) / high) > most:
        high += 1
    empty = (Line2D([], [], linestyle="none"), "")
    if most == 1 or high > even + 1:  # too much would stay empty: one after the other
        high = even
    else:
        methods += [empty] * (-len(methods) % high if others else 0)
    others += [empty] * (-len(methods + others) % high)
    return _Legend(methods + others, max(1, math.ceil(len(methods + others) / high)))


def _legend(figure: Figure, grid: np.ndarray, panels: int, legend: _Legend) -> None:
    handles, labels = zip(*legend.entries, strict=True)
    if not legend.columns:
        grid.flat[panels].legend(handles, labels, loc="center", labelspacing=0.45)
        return
    figure.legend(
        handles, labels, loc="outside lower center", ncols=legend.columns, columnspacing=1.4,
        labelspacing=0.35,
    )  # fmt: skip
