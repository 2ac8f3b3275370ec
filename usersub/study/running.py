# SPDX-License-Identifier: MIT
"""One run of a point, and many of them: here, in several processes, or on a cluster.

Which process a point runs in changes no bit of its error: every run makes its own driver, and
nothing is shared but compiled code.
"""

from __future__ import annotations

import math
import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from usersub.errors import Error, MissingTool, SceneError
from usersub.study import threads
from usersub.study.result import Point

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: What hosts raise on motions that a routine does not carry: no equilibrium, no root, overflow.
_FAILURES = (Error, ArithmeticError, RuntimeError, ValueError)

#: Tasks that a cluster holds at a time, for each of its threads.
_AHEAD = 3


@dataclass(frozen=True)
class Run:
    """One run of a point, as plain data.

    Attributes:
        key: of the point.
        refused: why it did not run; "" if it did. passing: the reason may be gone another time.
        error, error_of, step, points, tolerance, reference, says: as in `Result`.
        run_time_s, ns_per_point: of this run.
        version: release of usersub that ran it. machine: on what.
    """

    key: str
    refused: str = ""
    passing: bool = False
    error: float = math.nan
    error_of: str = ""
    step: float = math.nan
    points: int = 0
    tolerance: float = math.nan
    reference: str = "exact"
    says: str = ""
    run_time_s: float = math.nan
    ns_per_point: float = math.nan
    version: str = ""
    machine: str = ""


_warm: set[tuple[object, ...]] = set()


def run_point(point: Point) -> Run:
    """Runs a point in this process. The first run of its series is done twice, since it compiles,
    loads and touches memory; only the second counts."""
    from usersub.study.stamp import machine, version

    stamp = {"version": version(), "machine": machine()}
    series = (*point.series, point.content)
    try:
        if series not in _warm:
            _once(point)
            _warm.add(series)
        outcome, reference = _once(point)
    except MissingTool as error:
        return Run(point.key, refused=_words(error), passing=True, **stamp)
    except _FAILURES as error:
        return Run(point.key, refused=_words(error), **stamp)
    return Run(
        point.key, error=float(outcome.error), error_of=outcome.error_of, step=float(outcome.step),
        points=int(outcome.points), tolerance=float(outcome.tolerance), reference=reference,
        says=outcome.says, run_time_s=outcome.run_time_s, ns_per_point=outcome.ns_per_point,
        **stamp,
    )  # fmt: skip


def _words(error: BaseException) -> str:
    text = " ".join(str(error).split())
    return text if isinstance(error, Error) else f"{type(error).__name__}: {text}"


def _once(point: Point) -> tuple[Any, str]:
    """One run: its outcome, and what the error is against."""
    from usersub.problems import PROBLEMS
    from usersub.study import ladders, motions

    options: dict[str, Any] = dict(point.options)
    routine = _routine(point, point.precision, str(options.get("update", "")))
    if point.problem in motions.MOTIONS:
        settings = dict(point.settings)
        if not point.routine:
            settings = motions.law_settings(point.law, point.interface)
        outcome = motions.run(
            routine, lambda: _routine(point, "double"), point.problem, point.law, point.precision,
            point.method, point.step or motions.TIMES, point.block or motions.POINTS, settings,
        )  # fmt: skip
        return outcome, motions.REFERENCE
    problem = PROBLEMS[point.problem]
    ladder = ladders.ladder(problem, point.law, point.method)
    points = point.block or ladders.POINTS.get(point.problem)
    if points is not None:
        options["points"] = points
    if ladder is not None and point.step is not None:
        options[ladder.option] = ladder.value(point.step)
    outcome = problem.run(
        routine, law=point.law, precision=point.precision, method=point.method, **options
    )
    return outcome, "exact"


def _routine(point: Point, precision: str, update: str = "") -> Routine:
    if point.routine:
        return _of_file(point.routine, point.content, point.interface, precision)
    return _of_law(point.law, point.interface, point.language, precision, update)


@lru_cache(maxsize=256)
def _of_law(law: str, interface: str, language: str, precision: str, update: str) -> Routine:
    from usersub.problems import own

    return own.routine(own.updated(law, update), interface, language, precision)


@lru_cache(maxsize=16)
def _of_file(path: str, content: str, interface: str, precision: str) -> Routine:
    from usersub.routine.loading import load
    from usersub.study.files import content_of

    if content_of(path) != content:
        raise SceneError(f"{path} has changed since the study began")
    return load(path, precision=precision, interface=interface)[interface]


# Many runs.

#: Takes points, gives their runs as they are done.
Pool = Callable[[Iterable[Point]], Iterator[Run]]


@contextmanager
def pool(jobs: int = 1, scheduler: str | None = None) -> Iterator[Pool]:
    """Where points run: in this process, in `jobs` of them, or on the cluster of `scheduler`.

    Raises:
        MissingTool: `dask.distributed` is not installed.
        SceneError: nothing answers at that address.
    """
    if scheduler is not None:
        with _cluster(scheduler) as found:
            yield found
    elif jobs > 1:
        with _processes(jobs) as found:
            yield found
    else:
        yield lambda points: map(run_point, points)


@contextmanager
def _processes(jobs: int) -> Iterator[Pool]:
    from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
    from concurrent.futures.process import BrokenProcessPool
    from multiprocessing import get_context

    with _one_thread():  # which the children inherit
        executor = ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), initializer=_quiet)

    def runs(points: Iterable[Point]) -> Iterator[Run]:
        waiting, left = set(), iter(points)
        try:
            while True:
                with _one_thread():
                    while len(waiting) < 2 * jobs and (point := next(left, None)) is not None:
                        waiting.add(executor.submit(run_point, point))
                if not waiting:
                    return
                done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                for future in done:
                    yield future.result()
        except BrokenProcessPool as error:
            raise Error(
                "a process of the study ended unexpectedly; what is finished is kept. "
                "Run it with --jobs 1 to see where"
            ) from error

    try:
        yield runs
    finally:
        executor.shutdown(wait=True, cancel_futures=True)


def _quiet() -> None:
    """Ctrl-C is for the process that reads the keyboard; it ends the others."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)


@contextmanager
def _one_thread() -> Iterator[None]:
    before = {name: os.environ.get(name) for name in threads.NAMES}
    os.environ.update(dict.fromkeys(threads.NAMES, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


@contextmanager
def _cluster(address: str) -> Iterator[Pool]:
    try:
        from dask.distributed import Client, Future, as_completed
        from distributed.scheduler import KilledWorker
    except ImportError as error:
        raise MissingTool(
            "--scheduler needs dask.distributed: install it with `pip install 'usersub[cluster]'`"
        ) from error
    try:
        client = Client(address, timeout=10, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise SceneError(
            f"no Dask scheduler answers at '{address}', expected an address as in "
            "tcp://127.0.0.1:8786"
        ) from error

    def runs(points: Iterable[Point]) -> Iterator[Run]:
        left: deque[Point] = deque(points)
        threads = sum(client.nthreads().values())
        if not threads:
            raise SceneError(f"the Dask scheduler at {address} has no workers")

        def submit() -> Future:
            # A point runs again and again: it is no pure function of what is measured.
            return client.submit(run_point, left.popleft(), pure=False)

        ahead = [submit() for _ in range(min(len(left), _AHEAD * threads))]
        waiting = as_completed(ahead, loop=client.loop)
        for future in waiting:
            try:
                run = future.result()
            except KilledWorker as error:
                raise Error(
                    f"workers of {address} ended unexpectedly; what is finished is kept. "
                    "Run it with --jobs 1 to see where"
                ) from error
            if left:
                waiting.add(submit())
            yield _checked(run, address)

    with client:
        yield runs


def _checked(run: Run, address: str) -> Run:
    from usersub.study.stamp import version

    if run.version != version():
        raise SceneError(
            f"a worker of {address} has usersub {run.version}, expected {version()} as here"
        )
    return run
