# SPDX-License-Identifier: MIT
"""The matrix in parts, one a subject: in several processes, kept in a file as they are finished.

Which process a subject runs in changes nothing: each makes its own drivers. A process that dies or
does not come to an end is a verdict, too.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from functools import lru_cache
from pathlib import Path
from types import TracebackType

import numpy as np

from usersub.study.stability.cell import Cell
from usersub.study.stability.subjects import Subject

#: What tells subjects apart in a process of its own: laws, languages, precisions, drivers, quick.
Asked = tuple[tuple[str, ...] | None, tuple[str, ...], tuple[str, ...], bool | None, bool]


@lru_cache(maxsize=4)
def _chosen(asked: Asked) -> list[Subject]:
    from usersub.study.stability import whole

    laws, languages, precisions, drivers, _ = asked
    return list(whole.chosen(laws, languages, precisions, drivers))


Work = Callable[[Asked, int], list[Cell]]


def one(asked: Asked, number: int) -> list[Cell]:
    """Cells of one subject, in this process."""
    from usersub import messages_to
    from usersub.study.stability import whole

    messages_to(lambda *_: None)  # what routines say stands in the reasons
    with np.errstate(all="ignore"):
        return whole.of_subject(_chosen(asked)[number], asked[-1])


def in_processes(
    asked: Asked, numbers: Sequence[int], jobs: int, work: Work = one
) -> Iterator[tuple[int, list[Cell]]]:
    """Cells by number of the subject, as they come; of what made its process die, one that says so.

    What ran when a process died is run once more, each alone.
    """
    suspects: list[int] = []
    waiting, running = list(numbers), dict[Future[list[Cell]], int]()
    with _pool(jobs) as pool:
        while waiting or running:
            while waiting and len(running) < jobs:
                try:
                    future = pool.submit(work, asked, waiting[0])
                except BrokenProcessPool:
                    break
                running[future] = waiting.pop(0)
            if not running:
                break
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                number = running.pop(future)
                try:
                    yield number, future.result()
                except BrokenProcessPool:
                    suspects.append(number)
    for number in suspects:
        yield number, _alone(asked, number, work)
    if waiting:
        yield from in_processes(asked, waiting, jobs, work)


def _alone(asked: Asked, number: int, work: Work) -> list[Cell]:
    with _pool(1) as pool:
        try:
            return pool.submit(work, asked, number).result()
        except BrokenProcessPool:
            s = _chosen(asked)[number]
            return [Cell("all", "all", s.name, s.interface, s.language, s.precision, "fails",
                         "the process died")]  # fmt: skip


def _pool(jobs: int) -> ProcessPoolExecutor:
    # A process that is forked would share locks of threads that it does not have.
    return ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn"))


class Kept:
    """Finished parts in a file, a line each; those of other sources are forgotten.

    Args:
        file: where; None keeps nothing.
        name: what is run; another one begins anew.
    """

    def __init__(self, file: Path | None, name: str) -> None:
        self.file, self.found = file, dict[str, list[dict[str, object]]]()
        if file is None:
            return
        head = json.dumps({"sources": digest(), "run": name})
        lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
        whole = []
        if lines and lines[0] == head:
            for line in lines[1:]:
                try:
                    part = json.loads(line)
                except ValueError:  # the process ended while it wrote
                    break
                self.found[part["part"]] = part["rows"]
                whole.append(line)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("".join(f"{line}\n" for line in [head, *whole]), encoding="utf-8")
        self._stream = file.open("a", encoding="utf-8")

    def add(self, part: str, rows: Iterable[dict[str, object]]) -> None:
        """Keeps a part at once."""
        if self.file is not None:
            self._stream.write(json.dumps({"part": part, "rows": list(rows)}) + "\n")
            self._stream.flush()

    def __enter__(self) -> Kept:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:  # fmt: skip
        if self.file is not None:
            self._stream.close()


def digest() -> str:
    """Of all that the results depend on: the package, the laws, the headers, the library."""
    from usersub import paths

    found = hashlib.sha256()
    for folder in (Path(__file__).parents[2], paths.reference_impls(), paths.prefix()):
        for file in sorted(folder.rglob("*")):
            if file.suffix in (".py", ".c", ".f90", ".h", ".fi", ".so", ".toml"):
                found.update(file.name.encode() + b"\0" + file.read_bytes())
    return found.hexdigest()
