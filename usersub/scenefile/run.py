# SPDX-License-Identifier: MIT
"""Runs a scene file and writes the files it asks for."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from usersub import errors
from usersub.scenefile import explicit, results, standard
from usersub.scenefile.geometry import Progress
from usersub.scenefile.reader import SceneFile, read
from usersub.scenefile.setup import history_of, routine_of, scene_of


@dataclass
class Run:
    """What a scene file gave.

    Attributes:
        scene_file: what was read.
        history: the results of a history, or None.
        problem: the results of a problem (one object a row), empty for a history.
        plan: the plan of the driver as text, "" for a problem.
        written: the files that were written.
        ok: whether all is well; a problem may miss its tolerance.
    """

    scene_file: SceneFile
    history: results.HistoryResult | None = None
    problem: list[Any] = field(default_factory=list)
    plan: str = ""
    written: list[Path] = field(default_factory=list)
    ok: bool = True


def run_scene(path: str | Path, *, progress: Progress | None = None) -> Run:
    """Runs the scene file `path`.

    Args:
        path: a scene file; the paths in it are relative to its folder.
        progress: called with (rows done, rows in all).

    Raises:
        SceneError: the file says what cannot be; nothing has been written.
        CompileError, LoadError, MissingTool, AbiError, RoutineError: as the routine's loader and
            driver; nothing has been written.
    """
    scene_file = read(path)
    if scene_file.output.figure is not None:
        from usersub.scenefile import figure

        figure.require()
    tell = progress or (lambda done, total: None)
    if scene_file.problem is not None:
        run = _run_problem(scene_file)
    else:
        run = _run_history(scene_file, tell)
    _write(run)
    return run


def _run_history(scene_file: SceneFile, progress: Progress) -> Run:
    import usersub

    routine = routine_of(scene_file)
    settings, history = history_of(scene_file, routine.interface)
    try:
        scene = scene_of(scene_file, routine.interface.name, settings)
        driver = usersub.driver(routine, scene)
    except errors.SceneError as error:
        raise errors.SceneError(f"{scene_file.path}: {error}") from error
    result = results.HistoryResult(
        routine=scene_file.law or routine.name,
        interface=routine.interface.name,
        language=routine.language,
        precision=settings.get("precision", "double"),
        columns={},
    )
    runner = standard if routine.interface.solver == "standard" else explicit
    place = [0, len(history.time) - 1]

    def counted(done: int, total: int) -> None:
        place[0] = done
        progress(done, total)

    try:
        with np.errstate(all="ignore"):  # what is not finite in the end is told below
            runner.run(driver, settings, history, result, counted)
    except errors.RoutineError as error:
        begin, end = history.time[place[0]], history.time[place[0] + 1]
        error.args = (
            f"{error} (history row {place[0] + 1} of {place[1]}, time {begin:g} to {end:g})",
        )
        raise
    result.note_overflow()
    return Run(scene_file, history=result, plan=driver.plan.explain())


def _run_problem(scene_file: SceneFile) -> Run:
    from usersub import problems

    assert scene_file.problem is not None
    name, given = scene_file.problem
    options = {"precision": "double", **scene_file.settings, **given}
    if scene_file.routine is not None:
        options["routine"] = routine_of(scene_file)
    else:
        for key in ("law", "interface", "language"):
            if getattr(scene_file, key) is not None:
                options[key] = getattr(scene_file, key)
    known = problems.PROBLEMS.get(name.upper())
    if scene_file.output.files and known is not None and "history" in known.options:
        options.setdefault("history", True)
    try:
        outcome = problems.run(name, **options)
    except errors.SceneError as error:
        raise errors.SceneError(f"{scene_file.path}: {error}") from error
    return Run(scene_file, problem=[outcome], ok=outcome.ok)


def _write(run: Run) -> None:
    """Writes the files of [output]."""
    output = run.scene_file.output
    if not output.files:
        return
    history = _problem_history(run) if run.history is None else run.history
    if output.csv is not None:
        history.write_csv(output.csv)
    if output.npz is not None:
        history.write_npz(output.npz)
    if output.figure is not None:
        from usersub.scenefile import figure

        figure.draw(history, output.figure)
    run.written = output.files


def _problem_history(run: Run) -> results.Columns:
    outcome = run.problem[0]
    if not outcome.history:
        raise errors.SceneError(
            f"{run.scene_file.path}: [output] asks for {run.scene_file.output.files[0].name}, but "
            f"the problem {outcome.problem} gives no history"
        )
    return results.Columns(outcome.problem, dict(outcome.history))
