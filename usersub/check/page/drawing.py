# SPDX-License-Identifier: MIT
"""Drawings of what `figures` and `tangents` computed."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.page.canvas import decimal, line, logarithmic
from usersub.check.page.figures import Data

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Draw = Callable[["Figure"], None]

_RATE = "slip rate [length per time]"


def surface(data: Data) -> Draw:
    """Friction over load: contours and cuts where it varies with rate and load, else a curve."""

    def draw(figure: Figure) -> None:
        if data["by_rate"] and data["by_load"]:
            left, right = figure.subplots(1, 2)
            _contours(left, data)
            _cuts(right, data)
            return
        axes, values = figure.subplots(), np.array(data["values"])
        if data["by_rate"]:
            x, y = data["rates"], values[values.shape[0] // 2]
            axes.set_xlabel(_RATE)
        else:
            x, y = data["loads"], values[:, values.shape[1] // 2]
            axes.set_xlabel(data["load_name"])
        axes.plot(x, y, **line(0))
        logarithmic(axes, "x")
        axes.set_ylabel(f"{data['ratio']} [-]")
        _scaled(axes, data, np.array(y))

    return draw


def _contours(axes: Axes, data: Data) -> None:
    from matplotlib.ticker import FormatStrFormatter, LogLocator, MaxNLocator

    values = np.ma.masked_invalid(np.array(data["values"]))
    locator = LogLocator(numticks=9) if data["wide"] else MaxNLocator(7)
    levels = locator.tick_values(values.min(), values.max())
    greys = np.linspace(0.97, 0.66, max(len(levels) - 1, 1))
    x, y = data["rates"], data["loads"]
    axes.contourf(x, y, values, levels, colors=[str(g) for g in greys])
    lines = axes.contour(x, y, values, levels, colors="black", linewidths=1.0)
    logarithmic(axes, "x", "y")
    axes.clabel(
        lines, fmt=FormatStrFormatter("%.4g"), fontsize=8, inline_spacing=3,
        manual=_places_of_labels(lines, data),
    )  # fmt: skip
    axes.set_xlabel(_RATE)
    axes.set_ylabel(data["load_name"])
    axes.set_title(capital(data["ratio"]))


def _places_of_labels(lines: Any, data: Data) -> list[tuple[float, float]]:
    """A place on the longest piece of every contour, off the border and off its neighbours'."""
    corners = np.log([[data["rates"][0], data["loads"][0]], [data["rates"][-1], data["loads"][-1]]])
    places: list[tuple[float, float]] = []
    for segments in lines.allsegs:
        pieces = [s for s in segments if len(s) > 2]
        if not pieces:
            continue
        longest = max(pieces, key=len)
        share = (0.25, 0.5, 0.75)[len(places) % 3]
        place = longest[int(share * (len(longest) - 1))]
        inside = (np.log(place) - corners[0]) / (corners[1] - corners[0])
        if inside.min() > 0.07 and inside.max() < 0.93:
            places.append(tuple(place))
    return places


def _cuts(axes: Axes, data: Data) -> None:
    values = np.array(data["values"])
    count = len(data["loads"])
    word = data["load_name"].partition(" [")[0]
    for k, row in enumerate((0, count // 2, count - 1)):
        axes.plot(data["rates"], values[row], label=f"{word} {data['loads'][row]:.3g}", **line(k))
    logarithmic(axes, "x")
    axes.set_xlabel(_RATE)
    axes.set_ylabel(f"{data['ratio']} [-]")
    _scaled(axes, data, values)
    _legend_above(axes, 3)


def loop(data: Data) -> Draw:
    """The hysteresis loop under two loads; the way from rest to the first turn is thin."""

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        word = data["load_name"].partition(" [")[0]
        turn = data["turn"]
        for k, (load, friction) in enumerate(zip(data["loads"], data["friction"], strict=True)):
            x, style = data["motion"], line(k)
            axes.plot(x[: turn + 1], friction[: turn + 1], **{**style, "linewidth": 0.9})
            axes.plot(x[turn:], friction[turn:], label=f"{word} {load:.3g}", **style)
            # An arrow on the way back tells the sense of the loop.
            at = turn + (len(x) - turn) // 4
            ends = [(x[i], friction[i]) for i in (at, at + 1)]
            arrow = {"arrowstyle": "-|>", "color": style["color"], "mutation_scale": 14}
            axes.annotate("", xy=ends[1], xytext=ends[0], arrowprops=arrow)
        axes.axhline(0.0, color="0.5", lw=0.8)
        axes.set_xlabel("motion [length]")
        axes.set_ylabel(data["friction_name"])
        axes.margins(y=0.12)
        decimal(axes, "x")
        _legend_above(axes)

    return draw


def directions(data: Data) -> Draw:
    """Friction of all directions of sliding as a closed line, with a circle to compare."""

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        first, second = np.array(data["friction"])
        top = float(np.hypot(first, second).max())
        turn = np.linspace(0.0, 2.0 * np.pi, 121)
        axes.plot(
            top * np.cos(turn), top * np.sin(turn), label="the same in all directions",
            **{**line(1), "linewidth": 1.0},
        )  # fmt: skip
        closed = np.append(np.arange(first.size), 0)
        axes.plot(first[closed], second[closed], label="friction of the routine", **line(0))
        axes.axhline(0.0, color="0.5", lw=0.8)
        axes.axvline(0.0, color="0.5", lw=0.8)
        axes.set_aspect("equal")
        axes.set_xlabel(f"{data['ratio']},\ndirection 1 [-]")
        axes.set_ylabel(f"{data['ratio']},\ndirection 2 [-]")
        decimal(axes, "x")
        decimal(axes, "y")
        _legend_above(axes)

    return draw


def dependence(data: Data) -> Draw:
    """One panel for each temperature or field variable that friction depends on."""

    def draw(figure: Figure) -> None:
        panels = np.atleast_1d(figure.subplots(1, len(data["curves"])))
        for axes, curve in zip(panels, data["curves"], strict=True):
            axes.plot(curve["x"], curve["y"], **line(0))
            axes.set_xlabel(curve["name"] + (" [temperature]" * (curve["name"] == "temperature")))
            axes.set_ylabel(f"{data['ratio']} [-]")
            _from_zero(axes, np.array(curve["y"]))
            decimal(axes, "x")

    return draw


def stick_force(data: Data) -> Draw:
    """Friction force against stick force; the dashed line is the force that just sticks."""

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        x, y = np.array(data["stick"]), np.array(data["force"])
        axes.plot(x, y, label="friction of the routine", **line(0))
        half = x[: 1 + 5 * x.size // 8]
        axes.plot(half, half, label="stick force (does not slip)", **line(1))
        axes.set_xlabel("stick force over normal force [-]")
        axes.set_ylabel("friction force over normal force [-]")
        _from_zero(axes, np.append(y, half))
        _legend_above(axes)

    return draw


#: Classes of the relative error: upper bound, label, grey, hatch. Dark and hatched is bad.
CLASSES = (
    (1e-6, "up to 1e-6", "#f1f5f8", ""),
    (1e-4, "up to 1e-4", "#cfdde8", ""),
    (1e-2, "up to 1e-2", "#8fb2cf", ""),
    (1e-1, "up to 0.1", "#d55e00", "//"),
    (np.inf, "more than 0.1", "#4a1500", ""),
)


def tangent(data: Data) -> Draw:
    """A map of the error of every entry; rows are stress components, columns variables."""

    def draw(figure: Figure) -> None:
        from matplotlib.patches import Patch

        panels = figure.subplots(2, 3, sharex=True, sharey=True)
        for axes, entry in zip(panels.flat, data["entries"], strict=True):
            _error_map(axes, data, entry)
        for axes in panels[-1]:
            axes.set_xlabel("motion [length]")
        for axes in panels[:, 0]:
            axes.set_ylabel(data["load_name"])
        patches = [
            Patch(facecolor=colour, hatch=hatch, edgecolor="0.25", label=label)
            for _, label, colour, hatch in _classes(data)
        ]
        figure.legend(
            handles=patches, loc="outside upper center", ncols=5, title="relative error",
            handlelength=2.4, handleheight=1.2,
        )  # fmt: skip

    return draw


def _classes(data: Data) -> tuple[tuple[float, str, str, str], ...]:
    """The classes that differences in this precision can tell apart."""
    return tuple(c for c in CLASSES if c[0] >= data["floor"])


def _error_map(axes: Axes, data: Data, entry: dict[str, Any]) -> None:
    error, classes = np.array(entry["error"]), _classes(data)
    bounds, known = [c[0] for c in classes], np.isfinite(error)
    kind = np.searchsorted(bounds, np.where(known, error, 0.0))
    x, y = _edges(data["motions"]), _edges(data["loads"])
    axes.set_facecolor(classes[0][2])
    for index, (_, _, colour, hatch) in enumerate(classes[1:], 1):
        _cells(axes, x, y, known & (kind == index), colour, hatch)
    _cells(axes, x, y, ~known, "#ffffff", "")
    logarithmic(axes, "x", "y")
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(y[0], y[-1])
    axes.grid(False)
    axes.spines[["top", "right"]].set_visible(True)
    axes.set_title(entry["name"])
    worst, bound = error[known].max() if known.any() else np.inf, bounds[0]
    if worst <= bound:  # an even field alone would look like a picture that failed
        middle: dict[str, Any] = {"ha": "center", "va": "center", "transform": axes.transAxes}
        axes.text(0.5, 0.5, f"below {bound:.0e} everywhere", fontsize=8.5, color="0.2", **middle)
    elif np.isfinite(worst):
        axes.set_title(f"{entry['name']}: up to {worst:.2g}")


def _cells(
    axes: Axes, x: np.ndarray, y: np.ndarray, wanted: np.ndarray, colour: str, hatch: str
) -> None:
    """Fills runs of cells of a grid; runs keep the picture small."""
    for row in range(wanted.shape[0]):
        column = 0
        while column < wanted.shape[1]:
            if not wanted[row, column]:
                column += 1
                continue
            end = column
            while end < wanted.shape[1] and wanted[row, end]:
                end += 1
            axes.fill_between(
                [x[column], x[end]], y[row], y[row + 1], facecolor=colour, hatch=hatch or None,
                edgecolor="0.25" if hatch else colour, linewidth=0.0 if hatch else 0.4,
            )  # fmt: skip
            column = end


def _edges(centres: list[float]) -> np.ndarray:
    """Borders of cells around centres that stand on a logarithmic scale."""
    logs = np.log(centres)
    half = 0.5 * (logs[1] - logs[0])
    return np.exp(np.append(logs - half, logs[-1] + half))


def _scaled(axes: Axes, data: Data, values: np.ndarray) -> None:
    if data["wide"]:
        logarithmic(axes, "y")
    else:
        _from_zero(axes, values)


def _from_zero(axes: Axes, values: np.ndarray) -> None:
    """An axis that begins at zero, so that small variations do not look large."""
    finite = values[np.isfinite(values)]
    low = float(finite.min()) if finite.size else 0.0
    high = float(finite.max()) if finite.size else 0.0
    if low >= 0.0:
        axes.set_ylim(0.0, 1.15 * high if high > 0 else 1.0)


def _legend_above(axes: Axes, columns: int = 2) -> None:
    axes.legend(
        loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=columns, frameon=False,
        columnspacing=1.2, handlelength=2.2,
    )  # fmt: skip


def capital(text: str) -> str:
    """The text with a capital letter first."""
    return text[:1].upper() + text[1:]
