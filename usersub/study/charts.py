# SPDX-License-Identifier: MIT
"""Bars of what leaving out saves, the stability matrix, and limits beside their theory."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from usersub.study import canvas, words
from usersub.study.canvas import Picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from usersub.study.leaving_out import Saving
    from usersub.study.stability import Cell, Limit

_ROWS = 42  # rows of a picture that fit on a page

#: Greys and hatches of verdicts: the darker the worse.
VERDICTS: dict[str, dict[str, Any]] = {
    "stable": {"facecolor": "#eef3f7", "hatch": None, "edgecolor": "0.6"},
    "bounded": {"facecolor": "#a9c4dc", "hatch": "////", "edgecolor": "0.25"},
    "refused": {"facecolor": "#76706a", "hatch": "xxxx", "edgecolor": "0.92"},
    "fails": {"facecolor": "#5a0000", "hatch": None, "edgecolor": "0.0"},
}

#: Bars: what is drawn, fields of a saving, style.
_BARS: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("as needed", "needed", {"facecolor": "#2c5f8a", "edgecolor": "0.1"}),
    ("everything passed", "full", {"facecolor": "white", "hatch": "////", "edgecolor": "0.35"}),
    ("everything passed, general scene", "general",
     {"facecolor": "0.88", "hatch": "....", "edgecolor": "0.45"}),
)  # fmt: skip


def savings(found: Sequence[Saving]) -> list[Picture]:
    """Time and bytes of a contact point with the plan and with everything passed."""
    caption = (
        "Time and bytes of arguments of one contact point: with what routine and scene need "
        "(dark), with everything passed (hatched), and so in a scene that has "
        "everything (dotted). Numbers are the ratios to what is needed."
    )
    return _pictures("leaving-out", _parts(found, 14), caption, (1.15, 0.46), _savings)


def _parts(found: Sequence[Any], most: int) -> list[Sequence[Any]]:
    """Equal parts that fit on a page."""
    if not found:
        return []
    size = math.ceil(len(found) / math.ceil(len(found) / most))
    return [found[k : k + size] for k in range(0, len(found), size)]


def _pictures(
    name: str,
    parts: Sequence[Sequence[Any]],
    caption: str,
    height: tuple[float, float],
    draw: Callable[..., None],
) -> list[Picture]:
    """A picture of each part, as high as `height` says: without rows, and for each row."""
    return [
        Picture(
            name if len(parts) == 1 else f"{name}-{number}", caption, canvas.PAGE,
            height[0] + height[1] * len(part), partial(draw, found=part),
        )
        for number, part in enumerate(parts, 1)
    ]  # fmt: skip


def _savings(figure: Figure, found: Sequence[Saving]) -> None:
    from matplotlib.patches import Patch

    time, memory = figure.subplots(1, 2, sharey=True)
    _bars(time, found, "ns", "time per contact point [ns]")
    _bars(memory, found, "bytes", "arguments per contact point [B]")
    many = len({s.language for s in found}) > 1
    labels = [
        f"{s.interface.upper()}{f', {words.language(s.language)}' * many}: {s.scene}" for s in found
    ]  # fmt: skip
    time.set_yticks(range(len(found)), [_short(label, 40) for label in labels])
    time.set_ylim(len(found) - 0.45, -0.55)
    handles = [Patch(**style, label=label, linewidth=0.6) for label, _, style in _BARS]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)


def _bars(axes: Axes, found: Sequence[Saving], quantity: str, label: str) -> None:
    top = 0.0
    for row, saving in enumerate(found):
        needed = getattr(saving, f"{quantity}_needed")
        for index, (_, of, style) in enumerate(_BARS):
            value, y = getattr(saving, f"{quantity}_{of}"), row + 0.28 * (index - 1)
            if not math.isfinite(value):
                continue
            top = max(top, value)
            axes.barh(y, value, height=0.26, linewidth=0.6, **style)
            if index and needed > 0.0:
                axes.annotate(
                    f"{value / needed:.1f}×", (value, y), xytext=(3, 0), fontsize=7.0,
                    textcoords="offset points", va="center",
                )  # fmt: skip
    axes.set_xlim(0.0, 1.16 * top or 1.0)
    axes.locator_params(axis="x", nbins=5)
    axes.set_xlabel(label)
    axes.grid(False, axis="y")
    axes.tick_params(axis="y", length=0)


def _short(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 1].rstrip()}…"


def matrix(cells: Sequence[Cell]) -> list[Picture]:
    """Verdicts of all cases: a row a subject, or more where there are few; a column a case."""
    by_subject: dict[str, list[str]] = {}
    for cell in cells:
        by_subject.setdefault(cell.subject, []).append(cell.case)
    # In the order of who has most of them.
    ordered = sorted(by_subject.values(), key=lambda found: -len(set(found)))
    cases = list(dict.fromkeys(case for found in ordered for case in found))
    few = len({cell.subject for cell in cells}) <= 3
    rows: dict[str, list[Cell]] = {}
    for cell in cells:
        rows.setdefault(_row(cell, few), []).append(cell)
    found = "; ".join(f"{n} {v}" for v, n in Counter(c.verdict for c in cells).most_common())
    caption = (
        "Stiff and extreme cases. Where the runs of a cell (values, interfaces, languages, "
        f"precisions) differ, it is divided in proportion. Empty: not applicable. Runs: {found}."
    )
    draw = partial(_matrix, cases=cases)
    return _pictures("stability", _parts(list(rows.items()), _ROWS), caption, (1.45, 0.19), draw)


def _row(cell: Cell, few: bool) -> str:
    subject = words.law(cell.subject)
    if not few:
        return subject
    precision = ", single" if cell.precision == "single" else ""
    return f"{subject}: {cell.interface.upper()}, {words.language(cell.language)}{precision}"


def _matrix(
    figure: Figure, found: Sequence[tuple[str, Sequence[Cell]]], cases: Sequence[str]
) -> None:
    from matplotlib.patches import Patch, Rectangle

    axes = figure.subplots()
    for row, (_, cells) in enumerate(found):
        for column, case in enumerate(cases):
            here = Counter(cell.verdict for cell in cells if cell.case == case)
            left = column + 0.04
            for verdict, count in sorted(here.items(), key=lambda pair: _rank(pair[0])):
                wide = 0.92 * count / sum(here.values())
                style = VERDICTS.get(verdict, VERDICTS["fails"])
                axes.add_patch(Rectangle((left, row + 0.06), wide, 0.88, linewidth=0.5, **style))
                left += wide
    axes.set_xlim(0, len(cases))
    axes.set_ylim(len(found), 0)
    turned: dict[str, Any] = {"rotation": 40, "ha": "left", "rotation_mode": "anchor"}
    axes.set_xticks([c + 0.4 for c in range(len(cases))], [_short(c, 24) for c in cases], **turned)
    axes.xaxis.tick_top()
    axes.set_yticks([r + 0.5 for r in range(len(found))], [_short(name, 44) for name, _ in found])
    axes.tick_params(length=0)
    axes.grid(False)
    axes.spines[:].set_visible(False)
    shown = {cell.verdict for _, cells in found for cell in cells}
    handles = [
        Patch(**VERDICTS[v], label=v, linewidth=0.5) for v in VERDICTS if v in shown or v != "fails"
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), handleheight=1.2)


def _rank(verdict: str) -> int:
    return list(VERDICTS).index(verdict) if verdict in VERDICTS else len(VERDICTS)


#: What a measured limit may differ from its theory.
_BAND = 0.05
_REACH = 0.25  # largest difference that is drawn


def limits(found: Iterable[Limit]) -> list[Picture]:
    """Measured limits over their theory; those without a theory stand in the table alone."""
    known = [limit for limit in found if limit.ratio is not None and math.isfinite(limit.ratio)]
    caption = (
        "Measured limits divided by those of theory; the grey band is 5 %. Arrows point to values "
        "outside the axis."
    )
    return _pictures("limits", _parts(known, _ROWS), caption, (0.85, 0.19), _limits)


def _limits(figure: Figure, found: Sequence[Limit]) -> None:
    axes = figure.subplots()
    ratios = [limit.ratio or 0.0 for limit in found]
    reach = min(_REACH, max(2.0 * _BAND, *(1.15 * abs(ratio - 1.0) for ratio in ratios)))
    axes.axvspan(1.0 - _BAND, 1.0 + _BAND, color="0.9", zorder=0)
    axes.axvline(1.0, color="0.3", linewidth=0.8)
    for row, (limit, ratio) in enumerate(zip(found, ratios, strict=True)):
        inside = abs(ratio - 1.0) <= reach
        at = ratio if inside else 1.0 + math.copysign(reach, ratio - 1.0)
        marker = "o" if inside else ">" if ratio > 1.0 else "<"
        axes.plot(at, row, color="black", marker=marker, markersize=4.5, clip_on=False, zorder=4)
        unit = "" if limit.unit in ("", "-") else f" {limit.unit}"
        axes.annotate(
            f"{words.number(limit.measured, 3)} / {words.number(limit.theory, 3)}{unit}",
            (1.0, row), xycoords=("axes fraction", "data"), xytext=(6, 0),
            textcoords="offset points", va="center", fontsize=7.5,
        )  # fmt: skip
    axes.set_xlim(1.0 - reach, 1.0 + reach)
    axes.set_ylim(len(found) - 0.4, -0.6)
    axes.set_yticks(range(len(found)), [_short(_name(limit), 56) for limit in found])
    axes.set_xlabel("measured limit over theory [-]")
    axes.set_title("measured / theory", loc="right", fontsize=7.5)
    axes.grid(False, axis="y")


def _name(limit: Limit) -> str:
    subject = words.law(limit.subject.removeprefix("driver: "))
    how = limit.interface.upper() + (", single" if limit.precision == "single" else "")
    return f"{limit.name}: {subject} ({how})" if how else f"{limit.name}: {subject}"
