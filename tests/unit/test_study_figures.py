# SPDX-License-Identifier: MIT
"""Figures: readable in grey, nothing overlaps, the same bytes for the same data."""

from __future__ import annotations

import itertools
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from tests.unit.study_results import cell, ladder, limit, result, saving, study
from usersub.errors import MissingTool
from usersub.study import canvas, charts, figures, pareto
from usersub.study.canvas import Picture

pytest.importorskip("matplotlib")

_SMALLEST = 7.0  # points: what is legible in print


@contextmanager
def _drawn(picture: Picture) -> Iterator[Any]:
    with canvas._drawn(picture) as figure:
        figure.draw_without_rendering()
        yield figure


def _of_study() -> dict[str, Picture]:
    return {p.name: p for p in figures.pictures(pareto.fronts(study()))}


def _charts() -> dict[str, Picture]:
    cells = [
        cell(case, verdict, subject=subject)
        for subject in ("coulomb", "rate_state_strong_weakening", "driver: penalty", "iwan")
        for case, verdict in (
            ("pressure path", "stable"), ("pressure path", "refused"), ("slip", "bounded"),
            ("stick force", "stable"),
        )
    ]  # fmt: skip
    limits = [limit(1.0 + 0.02 * k, 1.0, name=f"limit {k}") for k in range(3)] + [limit(9.0, 1.0)]
    savings = [saving(scene=s) for s in ("general", "two-dimensional", "node-to-facet")]
    made = [*charts.savings(savings), *charts.matrix(cells), *charts.limits(limits)]
    return {p.name: p for p in made}


NAMES = (
    "p2-exponential-decay-time", "p2-exponential-decay-step", "p2-exponential-decay-block",
    "leaving-out", "stability", "limits",
)  # fmt: skip


@pytest.fixture(scope="module")
def pictures() -> dict[str, Picture]:
    return {**_of_study(), **_charts()}


def test_all_kinds_are_made(pictures: dict[str, Picture]) -> None:
    assert set(pictures) == set(NAMES)


def _texts(figure: Any) -> list[Any]:
    import matplotlib.text

    found = figure.findobj(matplotlib.text.Text)
    return [t for t in found if t.get_text().strip() and t.get_visible()]


@pytest.mark.parametrize("name", NAMES)
def test_texts_are_legible_inside_and_do_not_overlap(
    name: str, pictures: dict[str, Picture]
) -> None:
    with _drawn(pictures[name]) as figure:
        renderer = figure.canvas.get_renderer()
        texts = _texts(figure)
        assert min(text.get_fontsize() for text in texts) >= _SMALLEST
        # Labels of ticks outside the axes' limits are not drawn.
        boxes = [
            (text.get_text(), text.get_window_extent(renderer).padded(-1.0), text.get_rotation())
            for text in texts
        ]
        whole = figure.bbox.padded(1.0)
        shown = [b for b in boxes if b[1].width > 0 and b[1].height > 0 and _drawn_here(b, figure)]
        for label, box, _ in shown:
            assert whole.x0 <= box.x0 and box.x1 <= whole.x1, label
            assert whole.y0 <= box.y0 and box.y1 <= whole.y1, label
        assert len(shown) > 8
        straight = [(label, box) for label, box, turned in shown if turned in (0.0, 90.0)]
        for (first, a), (second, b) in itertools.combinations(straight, 2):
            assert not a.overlaps(b), f"{first!r} overlaps {second!r}"


def _drawn_here(box: tuple[str, Any, float], figure: Any) -> bool:
    """Whether a text is not the label of a tick that lies outside of what is shown."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
                for text in (tick.label1, tick.label2):
                    if text.get_text() == box[0] and not low <= tick.get_loc() <= high:
                        extent = text.get_window_extent().padded(-1.0)
                        if extent.x0 == box[1].x0 and extent.y0 == box[1].y0:
                            return False
    return True


def test_axes_have_names_and_units(pictures: dict[str, Picture]) -> None:
    with _drawn(pictures["p2-exponential-decay-time"]) as figure:
        shown = [axes for axes in figure.axes if axes.axison]
        assert len(shown) == 5
        assert {axes.get_title() for axes in shown} == {
            "FRIC", "FRIC_COEF", "VFRIC", "VFRICTION", "VFRIC_COEF",
        }  # fmt: skip
        assert {axes.get_xlabel() for axes in shown} - {""} == {"run time [s]"}
        assert {axes.get_ylabel() for axes in shown} - {""} == {"relative error [-]"}
        assert all(axes.get_xscale() == axes.get_yscale() == "log" for axes in shown)


def test_lines_of_a_panel_differ_without_colour(pictures: dict[str, Picture]) -> None:
    with _drawn(pictures["p2-exponential-decay-time"]) as figure:
        for axes in figure.axes:
            styles = [
                (line.get_marker(), line._unscaled_dash_pattern, line.get_markerfacecolor())
                for line in axes.lines
                if line.get_marker() in [m for m, _ in canvas.MARKS] and line.get_zorder() == 3
            ]
            assert len(styles) == len(set(styles))


def test_methods_differ_without_colour_however_many_there_are() -> None:
    from usersub.study.panels import _style

    styles = [_style(k, p) for k in range(2 * len(canvas.MARKS)) for p in ("double", "single")]
    shapes = [
        (s["marker"], s["markerfacecolor"] == "white", s.get("fillstyle")) for s in styles
    ]  # fmt: skip
    assert len(shapes) == len(set(shapes))


def test_options_are_in_the_order_of_their_numbers() -> None:
    slips = (1e-3, 1e-10, 0.5, 1e-4)
    runs = [result(options=(("elastic_slip", slip),)) for slip in slips]
    (front,) = pareto.fronts([*runs, result()])
    assert figures._methods(front) == (
        "implicit", *(f"implicit, elastic slip {s}" for s in ("1e-10", "1e-4", "1e-3", "0.5")),
    )  # fmt: skip


def test_verdicts_differ_in_lightness_and_hatch() -> None:
    from matplotlib.colors import to_rgb

    light = [
        sum(w * c for w, c in zip((0.299, 0.587, 0.114), to_rgb(s["facecolor"]), strict=True))
        for s in charts.VERDICTS.values()
    ]
    assert all(a > b + 0.15 for a, b in itertools.pairwise(light))
    assert charts.VERDICTS["bounded"]["hatch"] != charts.VERDICTS["refused"]["hatch"]


def test_a_cell_is_divided_in_proportion(pictures: dict[str, Picture]) -> None:
    cells = [cell("slip", "stable")] * 3 + [cell("slip", "refused")]
    (picture,) = charts.matrix(cells)
    with _drawn(picture) as figure:
        widths = [patch.get_width() for patch in figure.axes[0].patches]
    assert widths == pytest.approx([0.69, 0.23])
    assert "3 stable; 1 refused" in picture.caption


def test_limits_without_theory_are_not_drawn() -> None:
    assert charts.limits([limit(1e-17, 0.0), limit(3.0, None)]) == []
    (picture,) = charts.limits([limit(2.0, 1.0), limit(0.99, 1.0)])
    with _drawn(picture) as figure:
        drawn = {line.get_marker() for line in figure.axes[0].lines}
    assert {"o", ">"} <= drawn  # the first points out of the axis


def test_the_front_is_marked_in_its_panel_alone() -> None:
    runs = [*ladder(2), *(result(interface="vfric", error=1.0, run_time_s=9.0) for _ in range(2))]
    (front,) = pareto.fronts(runs)
    with _drawn(figures.error_against_time(front)) as figure:
        rings = {
            axes.get_title(): sum(
                len(line.get_xdata()) for line in axes.lines if line.get_markersize() > 9.0
            )
            for axes in figure.axes
        }
    assert rings == {"FRIC": 5, "VFRIC": 0}


def test_errors_of_zero_are_drawn_and_told() -> None:
    (front,) = pareto.fronts([result(error=0.0), result(error=1e-3, run_time_s=0.01)])
    picture = figures.error_against_time(front)
    assert "zero are drawn at 1e-17" in picture.caption
    assert canvas.files(picture, (".svg",))[".svg"]


def test_files_are_the_same_every_time(tmp_path, pictures: dict[str, Picture]) -> None:
    picture = pictures["p2-exponential-decay-block"]
    first, second = canvas.files(picture), canvas.files(picture)
    assert first == second
    assert b"<dc:date>" not in first[".svg"] and b"matplotlib" not in first[".png"]
    paths = figures.write(tmp_path, [picture])
    assert [path.name for path in paths] == [f"{picture.name}.svg", f"{picture.name}.png"]
    assert paths[0].read_bytes() == first[".svg"]


def test_two_kinds_of_errors_have_files_of_their_own() -> None:
    made = figures.pictures(pareto.fronts([result(error_of="time"), result(error_of="loop")]))
    assert [picture.name for picture in made] == [
        "p2-exponential-decay-time", "p2-exponential-decay-time-2",
    ]  # fmt: skip


def test_missing_matplotlib_is_told(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(canvas.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingTool, match="matplotlib.*pip install"):
        figures.write(tmp_path, [])


def test_nothing_heavy_is_imported_and_pyplot_never() -> None:
    code = (
        "import sys; from usersub.study import accuracy, charts, figures, page, pareto; "
        "assert not {'matplotlib', 'numba', 'dask', 'rich'} & set(sys.modules); "
        "from tests.unit.study_results import ladder; "
        "(front,) = pareto.fronts(ladder(2)); "
        "page.canvas.files(figures.error_against_time(front)); "
        "assert 'matplotlib.pyplot' not in sys.modules; "
        "assert not [m for m in sys.modules if m.startswith('usersub.check')]"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
