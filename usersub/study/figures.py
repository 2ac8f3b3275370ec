# SPDX-License-Identifier: MIT
"""Work-precision diagrams: error against run time, error against step, cost against block."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub.study import canvas, panels, words
from usersub.study.canvas import Picture
from usersub.study.orders import Curve, curves, order_words, size
from usersub.study.panels import Kind
from usersub.study.pareto import Front, heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from usersub.study.result import Result

#: Where errors of zero are drawn on logarithmic axes.
FLOOR = 1e-17

_BAND: dict[str, Any] = {"color": "0.78", "linewidth": 4.5, "solid_capstyle": "round"}
_RING: dict[str, Any] = {
    "linestyle": "none", "marker": "o", "markersize": 9.5, "markerfacecolor": "none",
    "markeredgecolor": "0.35", "markeredgewidth": 1.1,
}  # fmt: skip


def pictures(fronts: Iterable[Front]) -> list[Picture]:
    """All diagrams of errors and of blocks, in the order of the fronts; names differ."""
    made: list[Picture] = []
    for front in fronts:
        if front.runs:
            made += [error_against_time(front), *errors_against_step(front), *blocks(front)]
    counted: dict[str, int] = {}
    for index, picture in enumerate(made):
        count = counted[picture.name] = counted.get(picture.name, 0) + 1
        if count > 1:  # two kinds of errors of one problem
            made[index] = renamed(picture, f"{picture.name}-{count}")
    return made


def renamed(picture: Picture, name: str) -> Picture:
    """The picture under another name."""
    return replace(picture, name=name)


def write(
    folder: Path, made: Iterable[Picture], suffixes: Sequence[str] = (".svg", ".png")
) -> list[Path]:
    """Writes every picture into a folder that exists; returns the files.

    Raises:
        MissingTool: matplotlib is not installed.
    """
    canvas.require()
    paths = []
    for picture in made:
        for suffix, content in canvas.files(picture, suffixes).items():
            paths.append(folder / f"{picture.name}{suffix}")
            paths[-1].write_bytes(content)
    return paths


def file_name(*parts: str) -> str:
    """Parts in small letters with dashes between, for any file system."""
    return re.sub(r"[^a-z0-9]+", "-", "-".join(filter(None, parts)).lower()).strip("-")


def _picture(
    front: Front, name: str, caption: str, runs: Sequence[Result], kind: Kind, title: str = ""
) -> Picture:
    width, height = panels.size(runs, kind)
    return Picture(
        file_name(front.problem, front.law, name), caption, width, height,
        lambda figure: panels.draw(figure, runs, kind, title or heading(front)), front,
    )  # fmt: skip


def _methods(front: Front) -> tuple[str, ...]:
    """In the same order, with the same markers, in all figures of a problem."""
    runs = sorted((*front.runs, *front.blocks), key=_by_method)
    return tuple(dict.fromkeys(words.method(run) for run in runs))


def _by_method(run: Result) -> tuple[object, ...]:
    """Order of methods: by name, then by their numbers."""
    return run.method, [
        (name, value if isinstance(value, float | int) else 0.0, str(value))
        for name, value in run.options
    ]


def _error(run: Result) -> float:
    return max(run.error, FLOOR)


def error_against_time(front: Front) -> Picture:
    """The work-precision diagram, with quartiles of run time and the front marked."""

    def behind(axes: Axes, here: Sequence[Result]) -> None:
        corners = [(run.run_time_s, _error(run)) for run in front.front]
        x, y = zip(*corners, strict=True)
        axes.step(x, y, where="post", zorder=1, **_BAND)
        chosen = [(run.run_time_s, _error(run)) for run in front.front if run in here]
        axes.plot(*zip(*chosen, strict=True) if chosen else ((), ()), zorder=5, **_RING)

    def more() -> list[tuple[Any, str]]:
        from matplotlib.lines import Line2D

        band, ring = Line2D([], [], **_BAND), Line2D([], [], **_RING)
        return [((band, ring), "Pareto front")]

    kind = Kind(
        lambda run: run.run_time_s, _error, "run time [s]", "relative error [-]", _methods(front),
        line=lambda run: (run.series, run.block), spread=True, behind=behind, more=more,
    )  # fmt: skip
    caption = (
        f"{heading(front)}: error against run time. The points of a line differ in the time "
        "increment; bars reach from the first to the third quartile of the run time. Runs with "
        f"rings, on the grey band, are beaten by none in both error and run time.{_zeros(front)}"
    )
    return _picture(front, "time", caption, front.runs, kind)


def _zeros(front: Front) -> str:
    zero = any(run.error < FLOOR for run in front.runs)
    return f" Errors of zero are drawn at {words.number(FLOOR)}." if zero else ""


def errors_against_step(front: Front) -> list[Picture]:
    """Error against the time increment, or what else is refined, with observed orders."""
    found = curves(front.runs)
    return [
        _error_against(front, [curve for curve in found if curve.against == against])
        for against in dict.fromkeys(curve.against for curve in found)
    ]


def _error_against(front: Front, found: list[Curve]) -> Picture:
    runs = [run for curve in found for run in curve.runs]

    kind = Kind(
        size, _error, found[0].against, "relative error [-]", _methods(front),
        line=lambda run: (words.method(run), run.precision), languages=False, behind=_slopes,
        labels=lambda method: f"{method}: {_orders(found, method)}",
    )  # fmt: skip
    caption = (
        f"{heading(front)}: error against the {found[0].against.partition(' [')[0]}, the worst of "
        "the languages. Thin lines have the slopes 1, 2 and 4; orders in the legend are observed."
        f"{_zeros(front)}"
    )
    return _picture(front, "step", caption, runs, kind)


def _orders(found: Iterable[Curve], method: str) -> str:
    """Orders of a method through all interfaces, in double precision where there is one."""
    of_method = [curve for curve in found if curve.method == method]
    told = [c for c in of_method if c.precision == "double"] or of_method
    orders = sorted(c.order for c in told if c.order is not None)
    if not orders:
        return "rounding" if order_words(told[0]) == "rounding" else "no order"
    low, high = (f"{order + 0.0:.1f}".replace("-0.0", "0.0") for order in (orders[0], orders[-1]))
    return f"order {low}" if low == high else f"order {low} to {high}"


def _slopes(axes: Axes, here: Sequence[Result]) -> None:
    """A fan of the slopes 1, 2 and 4 where a panel has the fewest points."""
    (x0, x1), (y0, y1) = ([math.log10(v) for v in ends] for ends in (
        axes.get_xlim(), axes.get_ylim(),
    ))  # fmt: skip
    length = min(0.3 * (x1 - x0), 0.12 * (y1 - y0))
    points = [(math.log10(size(run)), math.log10(_error(run))) for run in here]
    margin, room = 0.06 * (x1 - x0), 0.8 * (y1 - y0) - 4.0 * length
    corners = [
        (left, y0 + 0.07 * (y1 - y0) + share * room)
        for share in (0.0, 1.0, 0.5, 0.25, 0.75)
        for left in (x1 - 1.5 * margin - length, x0 + margin)
    ]
    left, low = min(corners, key=lambda corner: _crowd(points, corner, length))
    for order, lift in ((1, -3.5), (2, 0.0), (4, 3.5)):
        ends = [10.0**left, 10.0 ** (left + length)], [10.0**low, 10.0 ** (low + order * length)]
        axes.plot(*ends, color="0.5", linewidth=0.7, zorder=1)
        axes.annotate(
            str(order), (ends[0][1], ends[1][1]), xytext=(2, lift), textcoords="offset points",
            color="0.35", fontsize=7.5, va="center",
        )  # fmt: skip


def _crowd(
    points: Iterable[tuple[float, float]], corner: tuple[float, float], length: float
) -> int:
    """Points in and near the place of a fan."""
    left, low = corner
    return sum(
        -0.7 * length <= x - left <= 1.7 * length and -1.5 * length <= y - low <= 5.5 * length
        for x, y in points
    )


def blocks(front: Front) -> list[Picture]:
    """Time of one contact point against the points of a call; nothing where no block varies."""
    finest: dict[tuple[object, ...], Result] = {}
    for run in front.blocks:
        if run.block is None or not 0.0 < run.ns_per_point < math.inf:
            continue
        known = finest.get((run.series, run.block))
        if known is None or (run.increments or 0) > (known.increments or 0):  # one is enough
            finest[run.series, run.block] = run
    if len({run.block for run in finest.values()}) < 2:
        return []
    kind = Kind(
        lambda run: float(run.block or 1), lambda run: run.ns_per_point,
        "contact points of a call [-]", "time per contact point [ns]", _methods(front),
        line=lambda run: run.series,
    )  # fmt: skip
    caption = (
        f"{front.title}: time of the median driver call over its contact points, against their "
        "number."
    )
    return [_picture(front, "block", caption, list(finest.values()), kind, front.title)]
