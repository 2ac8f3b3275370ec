# SPDX-License-Identifier: MIT
"""Figures for print: sizes, markers, dashes and hatches that are told apart without colour.

Figures are made without a window and without state that is shared; the same data give the same
bytes. matplotlib is imported only when something is drawn.
"""

from __future__ import annotations

import importlib.util
import io
import re
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from usersub.errors import MissingTool

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Widths of one and of two columns of a journal, in inches.
COLUMN, PAGE = 3.5, 7.0

#: Markers and colours of methods; colours differ in lightness too, and suit all eyes.
MARKS = (
    ("o", "#000000"), ("s", "#4aa3df"), ("^", "#c04a00"), ("D", "#d99a00"), ("v", "#00664b"),
    ("P", "#d07fae"), ("X", "#5b2a86"), ("<", "#8a8a8a"), (">", "#00508f"), ("*", "#9a7b00"),
    ("p", "#4d4d4d"), ("d", "#b0004e"), ("h", "#2f9090"), ("8", "#6d4c2f"),
)  # fmt: skip
#: Dashes of languages.
DASHES: dict[str, Any] = {"c": "-", "fortran": (0, (5, 2)), "python": (0, (1, 1.4))}
OTHER_DASH: Any = (0, (5, 1.5, 1, 1.5))

_SETTINGS: dict[Any, Any] = {
    "axes.axisbelow": True,
    "axes.grid": True,
    "axes.labelsize": 8.5,
    "axes.linewidth": 0.7,
    "axes.titlesize": 9.0,
    "figure.titlesize": 9.5,
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "grid.color": "0.85",
    "grid.linewidth": 0.5,
    "hatch.linewidth": 0.7,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "legend.handlelength": 2.6,
    "lines.linewidth": 1.1,
    "lines.markersize": 3.8,
    "svg.hashsalt": "usersub",
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
}
_RESOLUTION = 300  # dots an inch of PNG files


@dataclass(frozen=True)
class Picture:
    """A figure that can be drawn.

    Attributes:
        name: of its files, without suffix.
        caption: what it shows, in words; also for those who do not see it.
        width, height: inches.
        draw: draws into the empty figure.
        of: what it shows, if that is one thing.
    """

    name: str
    caption: str
    width: float
    height: float
    draw: Callable[[Figure], None]
    of: object = None


def require() -> None:
    """Raises MissingTool unless matplotlib is there."""
    if importlib.util.find_spec("matplotlib") is None:
        raise MissingTool(
            "figures of a study need matplotlib, which is not installed; get it with "
            "`pip install 'usersub[report]'`"
        )


def files(picture: Picture, suffixes: Sequence[str] = (".svg", ".png")) -> dict[str, bytes]:
    """The picture as files, by their suffix; letters of `.svg` are shapes."""
    written = {}
    with _drawn(picture) as figure:
        figure.set_dpi(_RESOLUTION)
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # all files have the same layout
        for suffix in suffixes:
            metadata = {"Software": None} if suffix == ".png" else _NONE
            written[suffix] = _saved(figure, suffix[1:], metadata, dpi=_RESOLUTION)
    return written


_NONE: dict[str, None] = dict.fromkeys(("Date", "Creator", "Format", "Type"))


def _saved(figure: Figure, kind: str, metadata: dict[str, None], **options: Any) -> bytes:
    written = io.BytesIO()
    figure.savefig(written, format=kind, metadata=metadata, **options)
    return written.getvalue()


@contextmanager
def _drawn(picture: Picture, letters: str = "path") -> Iterator[Figure]:
    """The figure; `letters`: "path" for shapes, "none" for text in a font of the reader's."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    settings = {**matplotlib.rcParamsDefault, **_SETTINGS, "svg.fonttype": letters}
    settings.pop("backend", None)  # which would be looked for
    with matplotlib.rc_context(settings), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # odd data make odd figures; readers are told in words
        figure = Figure(
            figsize=(picture.width, picture.height), layout=ConstrainedLayoutEngine(wspace=0.08)
        )
        FigureCanvasAgg(figure)
        picture.draw(figure)
        yield figure


_IDENTIFIER = re.compile(r'(\bid="|href="#|url\(#)([^")]+)')


def inline(picture: Picture) -> str:
    """The svg element for a page: identifiers of its own, no links to other places."""
    with _drawn(picture, "none") as figure:
        text = _saved(figure, "svg", _NONE).decode()
    text = text[text.index("<svg") :].rstrip()
    for useless in (r"<metadata>.*?</metadata>", r"<!--.*?-->"):
        text = re.sub(useless, "", text, flags=re.S)
    text = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", text).replace("xlink:href", "href")
    text = re.sub(r"<style.*?</style>", "", text, flags=re.S)  # stands in the page's style sheet
    text = _IDENTIFIER.sub(rf"\g<1>{picture.name}-\g<2>", text)
    return text.replace("<svg ", '<svg aria-hidden="true" focusable="false" ', 1)
