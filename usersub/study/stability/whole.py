# SPDX-License-Identifier: MIT
"""The stability matrix: every case through every driver, law, interface, language, precision."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from usersub.study.stability import cases, judging, running, subjects
from usersub.study.stability.cell import Cell
from usersub.study.stability.subjects import LANGUAGES, PRECISIONS, Scales, Subject

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

Progress = Callable[[int, int, str], None]


def matrix(
    laws: Sequence[str] | None = None,
    routine: Routine | None = None,
    *,
    languages: Sequence[str] = LANGUAGES,
    precisions: Sequence[str] = PRECISIONS,
    quick: bool = False,
    drivers: bool | None = None,
    props: Sequence[float] = (),
    states: int = 0,
    scales: Scales | None = None,
    progress: Progress | None = None,
) -> list[Cell]:
    """Runs stiff and extreme cases; a cell for each.

    Args:
        laws: shipped laws; None means all, unless a routine is given.
        routine: a user's own routine instead, with its `props` and number of `states`; it runs
            guarded, so that a fault or an endless loop becomes a verdict.
        languages, precisions: of shipped laws; a routine has its own language.
        quick: fewer values and shorter histories.
        drivers: whether enforcement by the drivers is in it; by default with all laws only.
        scales: ordinary sizes of the routine.
        progress: is told how many subjects are done, how many there are, and which comes.

    Returns:
        Cells in a fixed order; the same cells at each run.

    Raises:
        LoadError: unknown law. MissingTool: no compiler.
    """
    from usersub import messages_to
    from usersub.routine import messages

    before = messages._receiver
    chosen = list(_subjects(laws, routine, languages, precisions, drivers, props, states, scales))
    messages_to(lambda *_: None)  # what routines say stands in the reasons
    try:
        with np.errstate(all="ignore"):  # of routines that run uncompiled to explain themselves
            return _run(chosen, quick, progress)
    finally:
        messages_to(before)


def _run(chosen: Sequence[Subject], quick: bool, progress: Progress | None) -> list[Cell]:
    cells: list[Cell] = []
    for done, subject in enumerate(chosen):
        if progress is not None:
            progress(done, len(chosen), f"{subject.name} {subject.interface} {subject.language}")
        cells += of_subject(subject, quick)
    if progress is not None:
        progress(len(chosen), len(chosen), "")
    return cells


def of_subject(subject: Subject, quick: bool = False) -> list[Cell]:
    """All cases of one subject."""
    found: list[Cell] = []
    for history in cases.histories(subject, quick):
        trace = (
            running.run(history)
            if not history.refused
            else running.Trace(history, history.motion * float("nan"))
        )
        found += judging.judge(trace)
    return found


def _subjects(
    laws: Sequence[str] | None,
    routine: Routine | None,
    languages: Sequence[str],
    precisions: Sequence[str],
    drivers: bool | None,
    props: Sequence[float],
    states: int,
    scales: Scales | None,
) -> Iterator[Subject]:
    if routine is not None:
        yield from subjects.of_routine(routine, props, states, precisions, scales or Scales())
        if laws is None:
            return
    yield from subjects.of_laws(laws, languages, precisions)
    if drivers or (drivers is None and laws is None):
        yield from subjects.of_drivers(languages, precisions)
