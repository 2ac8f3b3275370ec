# SPDX-License-Identifier: MIT
"""The stability matrix: every case through every driver, law, interface, language, precision."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from usersub.study.stability import cases, judging, parts, running, subjects
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
    jobs: int = 1,
    keep: Path | None = None,
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
        jobs: processes at a time; a user's routine runs in this one.
        keep: a file in which finished subjects are kept. What stands there of the same sources is
            not run again.

    Returns:
        Cells in a fixed order; the same cells at each run.

    Raises:
        LoadError: unknown law. MissingTool: no compiler.
    """
    from usersub import messages_to
    from usersub.routine import messages

    before = messages._receiver
    shipped: list[Subject] = []
    if routine is None or laws is not None:
        shipped = list(chosen(laws, languages, precisions, drivers))
    asked = (None if laws is None else tuple(laws), tuple(languages), tuple(precisions), drivers,
             quick)  # fmt: skip
    messages_to(lambda *_: None)  # what routines say stands in the reasons
    try:
        with np.errstate(all="ignore"):  # of routines that run uncompiled to explain themselves
            cells = []
            if routine is not None:
                own = subjects.of_routine(routine, props, states, precisions, scales or Scales())
                cells = _run(list(own), quick, progress)
            return cells + _shipped(asked, shipped, progress, jobs, keep)
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


def _shipped(
    asked: parts.Asked, all_of: Sequence[Subject], progress: Progress | None, jobs: int,
    keep: Path | None,
) -> list[Cell]:  # fmt: skip
    """Laws and drivers, here or in several processes; what is kept is not run again."""
    with ExitStack() as stack:
        kept = stack.enter_context(parts.Kept(keep, repr(asked)))
        found = {
            number: [Cell(**row) for row in kept.found[str(number)]]  # type: ignore[arg-type]
            for number in range(len(all_of))
            if str(number) in kept.found
        }
        missing = [number for number in range(len(all_of)) if number not in found]
        several = jobs > 1 and len(missing) > jobs
        coming = (
            parts.in_processes(asked, missing, jobs)
            if several
            else ((number, of_subject(all_of[number], asked[-1])) for number in missing)
        )
        for number, cells in coming:
            found[number] = cells
            kept.add(str(number), [cell.as_dict() for cell in cells])
            if progress is not None:
                subject = all_of[number]
                words = f"{subject.name} {subject.interface} {subject.language}"
                progress(len(found), len(all_of), words)
    return [cell for number in range(len(all_of)) for cell in found[number]]


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


def chosen(
    laws: Sequence[str] | None,
    languages: Sequence[str],
    precisions: Sequence[str],
    drivers: bool | None,
) -> Iterator[Subject]:
    """Shipped laws, and drivers: by default with all laws only."""
    yield from subjects.of_laws(laws, languages, precisions)
    if drivers or (drivers is None and laws is None):
        yield from subjects.of_drivers(languages, precisions)
