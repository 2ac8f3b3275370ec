# SPDX-License-Identifier: MIT
"""The figure of a history: friction stress against slip and against time (extra `report`)."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np

from usersub.errors import MissingTool, SceneError
from usersub.scenefile.results import Columns, HistoryResult

_LINES = 8
_TICKS = 5  # labels such as -0.0075 do not touch each other
_UNITS = "units are given by the user's unit system"


def require() -> None:
    """Raises MissingTool unless matplotlib is there."""
    if importlib.util.find_spec("matplotlib") is None:
        raise MissingTool(
            "[output] figure needs matplotlib, which is not installed; get it with "
            "`pip install 'usersub[report]'`"
        )


def draw(history: HistoryResult | Columns, path: Path) -> None:
    """Draws a history into a PNG or SVG file.

    Of contact points: the friction stress of up to eight points and directions against slip and
    time. Of a problem: every column against the first.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9.0, 4.0), layout="constrained")
    if isinstance(history, Columns):
        _draw_columns(figure, history)
    else:
        _draw_points(figure, history)
    figure.supxlabel(_UNITS, fontsize="small")
    try:
        figure.savefig(path, dpi=150)
    except OSError as error:
        raise SceneError(f"{path}: cannot be written: {error.strerror}") from error


def _draw_points(figure: Any, history: HistoryResult) -> None:
    columns = history.columns
    against_slip, against_time = figure.subplots(1, 2)
    directions = columns["tau"].shape[2]
    lines = [(p, d) for p in range(history.points) for d in range(directions)]
    for point, direction in lines[:_LINES]:
        label = f"point {point}, direction {direction + 1}"
        tau = columns["tau"][:, point, direction]
        against_slip.plot(columns["slip"][:, point, direction], tau, label=label)
        against_time.plot(columns["time"], tau, label=label)
    against_slip.set_xlabel("slip [length]")
    against_time.set_xlabel("time [time]")
    for axes in (against_slip, against_time):
        axes.locator_params(axis="x", nbins=_TICKS)
        axes.set_ylabel("friction stress [stress]")
        axes.grid(alpha=0.3)
    if len(lines) > 1:
        against_time.legend(fontsize="small")
    figure.suptitle(
        f"{history.routine}: {history.interface.upper()}, {history.language}, {history.precision}"
    )


def _draw_columns(figure: Any, history: Columns) -> None:
    first, *others = history.columns
    for axes, name in zip(np.ravel(figure.subplots(1, len(others))), others, strict=True):
        axes.plot(history.columns[first], history.columns[name])
        axes.locator_params(axis="x", nbins=_TICKS)
        axes.set_xlabel(first)
        axes.set_ylabel(name.replace("_", " "))
        axes.grid(alpha=0.3)
    figure.suptitle(history.title)
