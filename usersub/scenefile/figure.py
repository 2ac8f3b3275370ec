# SPDX-License-Identifier: MIT
"""The figure of a history: friction stress against slip and against time (extra `report`)."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np

from usersub.errors import MissingTool, SceneError
from usersub.scenefile.results import HistoryResult

_LINES = 8


def require() -> None:
    """Raises MissingTool unless matplotlib is there."""
    if importlib.util.find_spec("matplotlib") is None:
        raise MissingTool(
            "[output] figure needs matplotlib, which is not installed; get it with "
            "`pip install 'usersub[report]'`"
        )


def draw(history: HistoryResult, path: Path) -> None:
    """Draws the friction stress of up to eight points and directions into a PNG or SVG file."""
    from matplotlib.figure import Figure

    columns = history.columns
    figure = Figure(figsize=(9.0, 4.0), layout="constrained")
    against_slip, against_time = figure.subplots(1, 2)
    directions = columns["tau"].shape[2]
    lines = [(p, d) for p in range(history.points) for d in range(directions)]
    for point, direction in lines[:_LINES]:
        label = f"point {point}, direction {direction + 1}"
        tau = columns["tau"][:, point, direction]
        against_slip.plot(columns["slip"][:, point, direction], tau, label=label)
        against_time.plot(columns["time"], tau, label=label)
    against_slip.set_xlabel("slip (length, in the unit system of the scene)")
    against_time.set_xlabel("time (in the unit system of the scene)")
    for axes in (against_slip, against_time):
        axes.set_ylabel("friction stress (in the unit system of the scene)")
        axes.grid(alpha=0.3)
    if len(lines) > 1:
        against_time.legend(fontsize="small")
    figure.suptitle(
        f"{history.routine}: {history.interface.upper()}, {history.language}, {history.precision}"
    )
    if not np.all(np.isfinite(columns["tau"])):
        history.notes.append("the figure leaves out values that are not finite")
    try:
        figure.savefig(path, dpi=150)
    except OSError as error:
        raise SceneError(f"{path}: cannot be written: {error.strerror}") from error
