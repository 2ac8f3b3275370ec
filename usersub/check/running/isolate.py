# SPDX-License-Identifier: MIT
"""Work in child processes, whatever a routine does there: crash, exit, loop, smash the heap.

    outcome = isolate.run(lambda child: child.say({"answer": 42}), seconds=5.0)
    outcome.said, outcome.how, outcome.case

A child is a fork of this process with its own process group, an empty folder as its working
directory, standard streams of its own and a time limit, of computing rather than of waiting for
others. What it says (plain data) arrives even if it dies right after; the case that it was at is
kept in memory that both share.
"""

from __future__ import annotations

import contextlib
import mmap
import os
import select
import shutil
import signal
import tempfile
import time
import warnings
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from usersub.check.running.children import CASE_BYTES, Child, Outcome, case_of, output_of
from usersub.check.running.inside import Channel, enter

#: What a child is given to do.
Work = Callable[[Channel], object]

#: How a child ended.
RETURNED, EXITED, SIGNALLED, TIME = "returned", "exited", "signalled", "time"

#: Seconds between two looks at children where the system has no descriptor for processes.
_POLL = 0.01


def start(work: Work, seconds: float, folder: Path) -> Child:
    """Starts a child that does `work` within `seconds`, in a new folder in `folder`."""
    home = Path(tempfile.mkdtemp(dir=folder))
    notes = mmap.mmap(-1, CASE_BYTES)
    reader, writer = os.pipe()
    with warnings.catch_warnings():
        # Threads that wait somewhere (a test runner's, the one that watches for Ctrl-C) hold no
        # lock that a child would need.
        warnings.simplefilter("ignore", DeprecationWarning)
        process = os.fork()
    if process == 0:
        try:
            os.close(reader)
            enter(Channel(writer, notes), work, home, seconds)
        finally:
            os._exit(70)
    os.close(writer)
    with contextlib.suppress(OSError):  # the child does the same; whoever comes first
        os.setpgid(process, process)
    os.set_blocking(reader, False)
    try:
        handle = os.pidfd_open(process)
    except (AttributeError, OSError):
        handle = None
    return Child(process, reader, handle, notes, home, time.monotonic(), seconds)


def wait(children: Iterable[Child]) -> Child | None:
    """Waits until one of the children has ended or is over its time, and gives it.

    None after at most a tenth of a second, so that the caller can look around.
    """
    children = list(children)
    now = time.monotonic()
    until = min([now + 0.1, *(c.next_look for c in children)])
    watched = {c.reader: c for c in children}
    exits = {c.handle for c in children if c.handle is not None}
    pause = max(0.0, until - now) if len(exits) == len(children) else _POLL
    poll = select.poll()
    for descriptor in (*watched, *exits):
        poll.register(descriptor, select.POLLIN)
    ready = {descriptor for descriptor, _ in poll.poll(1e3 * pause)}
    for reader in ready & set(watched):
        watched[reader].read()
    for child in children:
        if child.handle in ready or (child.handle is None and child.ended()):
            return child
    if ready:  # a stream that has ended is ready for ever: its process may still run
        time.sleep(1e-3)
    return next((c for c in children if c.late()), None)


def finish(child: Child) -> Outcome:
    """Ends a child and all that it has started, and tells how it ended."""
    late = not child.ended()
    for _ in range(2):  # once more for what was forked in between
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(child.process, signal.SIGKILL)
        with contextlib.suppress(ProcessLookupError):
            os.kill(child.process, signal.SIGKILL)
    _, status = os.waitpid(child.process, 0)
    child.read()
    for descriptor in (child.reader, child.handle):
        if descriptor is not None:
            os.close(descriptor)
    said = tuple(m for m in child.said if m != Channel.END)
    returned = Channel.END in child.said
    crashed = os.WIFSIGNALED(status) and not late
    output, size = output_of(child.folder, child.output_at)
    how = RETURNED if returned else TIME if late else SIGNALLED if crashed else EXITED
    outcome = Outcome(
        how,
        said,
        code=0 if os.WIFSIGNALED(status) else os.WEXITSTATUS(status),
        signal=os.WTERMSIG(status) if crashed else 0,
        late=returned and crashed,
        case=case_of(child.notes),
        output=output,
        output_bytes=size,
        seconds=time.monotonic() - child.start,
    )
    child.notes.close()
    shutil.rmtree(child.folder, ignore_errors=True)
    return outcome


def stages(outcome: Outcome) -> list[tuple[str, Outcome]]:
    """The stages that a child came to (`Channel.stage`), each with an outcome of its own.

    All but the last have returned; the end of the process is that of the last.
    """
    places = [k for k, m in enumerate(outcome.said) if isinstance(m, dict) and Channel.STAGE in m]
    marks = [outcome.said[k] for k in places]
    found = []
    for number, (place, mark) in enumerate(zip(places, marks, strict=True)):
        last = number == len(places) - 1
        said = outcome.said[place + 1 : None if last else places[number + 1]]
        until = outcome.seconds if last else marks[number + 1]["since"]
        whole = outcome if last else Outcome(RETURNED)
        found.append(
            (mark[Channel.STAGE], replace(whole, said=said, seconds=until - mark["since"]))
        )
    return found


@contextlib.contextmanager
def scratch() -> Iterator[Path]:
    """A folder for the working directories of children; removed at the end."""
    folder = Path(tempfile.mkdtemp(prefix="usersub-check-"))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def run(work: Work, seconds: float) -> Outcome:
    """Does `work` in a child and waits for its end."""
    with scratch() as folder:
        child = start(work, seconds, folder)
        try:
            while wait([child]) is None:
                pass
        except BaseException:
            finish(child)
            raise
        return finish(child)


def run_all(
    jobs: Iterable[tuple[Any, Work, float]], workers: int = 1
) -> Iterator[tuple[Any, Outcome]]:
    """Does the work of several jobs, up to `workers` at a time.

    Args:
        jobs: key, work and time limit of each; the next is asked for when a worker is free, again
            also after there was none: the end of another may have made one.

    Yields:
        key and outcome of each, as they end.
    """
    running: dict[int, tuple[Any, Child]] = {}
    queue = iter(jobs)
    with scratch() as folder:
        try:
            more = True
            while more or running:
                while more and len(running) < max(workers, 1):
                    job = next(queue, None)
                    more = job is not None
                    if job is not None:
                        key, work, seconds = job
                        child = start(work, seconds, folder)
                        running[child.process] = (key, child)
                if not running:
                    return
                done = wait(c for _, c in running.values())
                if done is not None:
                    key, _ = running.pop(done.process)
                    yield key, finish(done)
                    more = True
        finally:
            for _, child in running.values():
                finish(child)
