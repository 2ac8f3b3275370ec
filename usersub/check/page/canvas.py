# SPDX-License-Identifier: MIT
"""Figures as inline SVG: made with matplotlib, the same for the same data, without a window."""

from __future__ import annotations

import importlib.util
import io
import re
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from usersub.errors import MissingTool

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Lines that can be told apart by colour (by people who do not see all colours) and in grey.
LINES: tuple[dict[str, Any], ...] = (
    {"color": "#000000", "linestyle": "-"},
    {"color": "#0072b2", "linestyle": "--"},
    {"color": "#d55e00", "linestyle": "-."},
    {"color": "#009e73", "linestyle": ":"},
    {"color": "#cc79a7", "linestyle": (0, (5, 1, 1, 1, 1, 1))},
)
#: Marker of the offending point and increment.
OFFENDER: dict[str, Any] = {
    "marker": "o", "markersize": 13, "markerfacecolor": "none", "markeredgecolor": "#d55e00",
    "markeredgewidth": 2.2, "linestyle": "none", "clip_on": False, "zorder": 5,
}  # fmt: skip

_SETTINGS: dict[Any, Any] = {
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "axes.grid": True,
    "axes.labelsize": 9.0,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 9.5,
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "grid.alpha": 0.35,
    "grid.linewidth": 0.6,
    "hatch.linewidth": 0.6,
    "legend.fontsize": 8.5,
    "legend.framealpha": 0.9,
    "lines.linewidth": 1.6,
    "svg.fonttype": "none",
    "svg.hashsalt": "usersub",
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
}
_IDENTIFIER = re.compile(r'(\bid="|href="#|url\(#)([^")]+)')


def require() -> None:
    """Raises MissingTool unless matplotlib is there."""
    if importlib.util.find_spec("matplotlib") is None:
        raise MissingTool(
            "the HTML page has figures and needs matplotlib, which is not installed; get it with "
            "`pip install 'usersub[report]'`"
        )


def drawn(draw: Callable[[Figure], None], width: float, height: float, name: str) -> str:
    """The SVG element of a figure.

    Args:
        draw: draws into the figure.
        width, height: inches.
        name: prefix of all identifiers in it, unique on the page.
    """
    import matplotlib
    from matplotlib.figure import Figure

    settings = {**matplotlib.rcParamsDefault, **_SETTINGS}
    with matplotlib.rc_context(settings), warnings.catch_warnings():
        # Odd routines make odd figures; their readers are told in words.
        warnings.simplefilter("ignore")
        figure = Figure(figsize=(width, height), layout="constrained")
        draw(figure)
        written = io.StringIO()
        none = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(written, format="svg", metadata=none)
    return _inline(written.getvalue(), name)


def _inline(svg: str, name: str) -> str:
    """The svg element alone, with identifiers of its own and without links to other places.

    What all figures share (font, joints of lines) stands in the style sheet of the page.
    """
    svg = svg[svg.index("<svg") :].rstrip()
    for useless in (r"<metadata>.*?</metadata>", r"<style.*?</style>", r"<!--.*?-->"):
        svg = re.sub(useless, "", svg, flags=re.S)
    svg = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", svg).replace("xlink:href", "href")
    svg = re.sub(r"font: ([\d.]+px) 'DejaVu Sans'", r"font-size: \1", svg)
    svg = svg.replace("; font-family: 'DejaVu Sans'", "")
    svg = _IDENTIFIER.sub(rf"\g<1>{name}-\g<2>", svg)
    used = set(re.findall(r"(?:href=\"#|url\(#)([^\")]+)", svg))
    svg = re.sub(r'\sid="([^"]*)"', lambda m: m[0] if m[1] in used else "", svg)
    svg = re.sub(r"\s*\n\s*", "\n", re.sub(r"<defs>\s*</defs>", "", svg))
    return svg.replace("<svg ", '<svg aria-hidden="true" focusable="false" ', 1)


def line(index: int) -> dict[str, Any]:
    """Style of the line with this number."""
    return LINES[index % len(LINES)]


def decimal(axes: Axes, axis: str) -> None:
    """Few ticks with plain numbers, so that labels do not touch."""
    axes.locator_params(axis=axis, nbins=5)  # type: ignore[arg-type]


def logarithmic(axes: Axes, *names: str) -> None:
    """Logarithmic axes with plain numbers at decades."""
    from matplotlib.ticker import FuncFormatter, NullLocator

    for name in names:
        (axes.set_xscale if name == "x" else axes.set_yscale)("log")
        axis = axes.xaxis if name == "x" else axes.yaxis
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
