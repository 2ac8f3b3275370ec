# SPDX-License-Identifier: MIT
"""A study from its points to its results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from usersub.study import running, timing
from usersub.study.result import Point, Result
from usersub.study.stamp import stamp
from usersub.study.store import Store

#: Told after every run: how many are done, of how many, and which point it was.
Progress = Callable[[int, int, Point], None]


@dataclass(frozen=True)
class Study:
    """What a study found.

    Attributes:
        results: of the points that have all their runs, in their order.
        stamp: machine and versions.
        unfinished: points that lack runs, after an interruption.
        ran: runs of this session; `kept`: runs that were there before.
        files: written, without the page and its figures.
    """

    results: list[Result]
    stamp: dict[str, str]
    unfinished: int = 0
    ran: int = 0
    kept: int = 0
    files: list[Path] = field(default_factory=list)


def study(
    points: Sequence[Point],
    folder: str | Path | None = None,
    *,
    repeats: int = timing.REPEATS,
    jobs: int = 1,
    scheduler: str | None = None,
    fresh: bool = False,
    progress: Progress | None = None,
) -> Study:
    """Runs points, each `repeats` times in turns, and measures error and run time.

    Args:
        points: from `usersub.study.points`.
        folder: where every run is kept at once; what is there already is not run again.
        jobs: processes at a time. More than one disturb each other's times, not their errors.
        scheduler: address of a Dask scheduler, whose workers run the points.
        fresh: forget what the folder has of the same study.
        progress: told after every run.

    Returns:
        The study; after Ctrl-C with the points that are finished, and `unfinished` above zero.

    Raises:
        SceneError: the folder holds another study, or the scheduler does not answer.
        MissingTool: `scheduler` without dask.distributed.
        OSError: the folder cannot be written.
    """
    place = None if folder is None else Path(folder)
    by_key = {point.key: point for point in points}
    with Store(place, points, repeats, fresh=fresh) as store:
        kept = sum(store.done.values())
        ran, unfinished, done, whole = 0, 0, kept, repeats * len(by_key)
        try:
            with running.pool(jobs, scheduler) as pool:
                for waiting in timing.turns(points, store.done, repeats):
                    for run in pool(waiting):
                        point = by_key[run.key]
                        before = store.done.get(run.key, 0)
                        store.add(point, run)
                        done, ran = done + store.done[run.key] - before, ran + 1
                        if progress is not None:
                            progress(done, whole, point)
        except KeyboardInterrupt:
            unfinished = sum(store.done.get(key, 0) < repeats for key in by_key)
        told = stamp()
        if len(store.machines) > 1 or (store.machines and scheduler):
            told["machine"] = "; ".join(store.machines)
        files = store.write(told)
        return Study(store.results(), told, unfinished, ran, kept, files)
