# SPDX-License-Identifier: MIT
"""Child processes as their parent sees them, see `usersub.check.running.isolate`."""

from __future__ import annotations

import contextlib
import json
import mmap
import os
import signal
import struct
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from usersub.check.case import Case
from usersub.check.clocks import is_late, processor_time
from usersub.check.running.inside import Channel

#: Bytes for the case under way, and those of the output that are kept.
CASE_BYTES, _KEPT = 1 << 18, 4000
#: Looks one after the other at which an idle child over its time counts as one that never ends.
_IDLE_LOOKS = 5


@dataclass(frozen=True)
class Outcome:
    """How a child ended.

    Attributes:
        how: "returned" (the work came to its end), "exited" (the process ended before), "signalled"
            (it crashed) or "time" (it was ended at its time limit).
        said: what it said, in order.
        code: exit code, where it exited; signal: number of the signal, where it was signalled.
        late: the work came to its end, but the process died after it, as a damaged heap makes it.
        case: the case that it was at last, or None.
        output: the first lines that it wrote to its standard streams; output_bytes: size of all.
        seconds: how long it lived.
    """

    how: str
    said: tuple[Any, ...] = ()
    code: int = 0
    signal: int = 0
    late: bool = False
    case: Case | None = None
    output: str = ""
    output_bytes: int = 0
    seconds: float = 0.0

    @property
    def signal_name(self) -> str:
        """Name of the signal, for example "SIGSEGV"; "" if there was none."""
        try:
            return signal.Signals(self.signal).name if self.signal else ""
        except ValueError:
            return f"signal {self.signal}"


@dataclass
class Child:
    """A child that runs."""

    process: int
    reader: int
    handle: int | None
    notes: mmap.mmap
    folder: Path
    start: float
    seconds: float
    said: list[Any] = field(default_factory=list)
    rest: bytes = b""

    def __post_init__(self) -> None:
        self.began, self.computed_before, self.output_at = self.start, 0.0, 0
        self.idle_looks = 0

    def read(self) -> bool:
        """Reads what there is; False at the end of the stream."""
        while True:
            try:
                data = os.read(self.reader, 1 << 16)
            except BlockingIOError:
                return True
            if not data:
                return False
            *lines, self.rest = (self.rest + data).split(b"\n")
            for line in lines:
                with contextlib.suppress(ValueError):  # a damaged process says damaged things
                    self._hear(json.loads(line))

    def _hear(self, message: Any) -> None:
        self.said.append(message)
        if isinstance(message, dict) and Channel.STAGE in message:
            self.began, self.computed_before = time.monotonic(), self._computed()
            self.seconds, self.output_at = message["seconds"], message["at"]
            message["since"] = message["time"] - self.start

    @property
    def next_look(self) -> float:
        """When to see again whether it is over its time."""
        limit = self.began + self.seconds
        return limit if time.monotonic() < limit else time.monotonic() + 0.05

    def late(self) -> bool:
        """Whether it is over its time: by the clock and, since the machine may be busy with other
        things, by what it has computed."""
        lived = time.monotonic() - self.began
        if lived < self.seconds:
            return False
        computed = self._computed() - self.computed_before
        self.idle_looks = self.idle_looks + 1 if self._idle() else 0
        return self.idle_looks >= _IDLE_LOOKS or is_late(lived, computed, self.seconds)

    def _idle(self) -> bool:
        """Whether it sleeps without a child that it could wait for, as it does in a deadlock."""
        tasks = Path(f"/proc/{self.process}/task")
        try:
            states = [
                (task / "stat").read_text(encoding="utf-8", errors="replace").rpartition(")")[2]
                for task in tasks.iterdir()
            ]
            waits_for = [(task / "children").read_text() for task in tasks.iterdir()]
        except OSError:
            return False  # the system does not tell, or it has just ended
        return all(s.split()[0] == "S" for s in states) and not any(waits_for)

    def _computed(self) -> float:
        """Processor time so far, seconds; that of the clock where the system does not tell."""
        found = processor_time(self.process)
        return self.computed_before + self.seconds if found is None else found

    def ended(self) -> bool:
        """Whether the process has ended; it stays in the table of processes."""
        found = os.waitid(os.P_PID, self.process, os.WEXITED | os.WNOWAIT | os.WNOHANG)
        return found is not None


def output_of(folder: Path, start: int) -> tuple[str, int]:
    """First characters from `start` on, and the size of all."""
    file = folder / Channel.OUTPUT
    try:
        size = file.stat().st_size
        with file.open("rb") as opened:
            opened.seek(start)
            return opened.read(_KEPT).decode("utf-8", "replace"), size
    except OSError:
        return "", 0


def case_of(notes: mmap.mmap) -> Case | None:
    """The case that a child was at last, or None."""
    (size,) = struct.unpack_from("<Q", notes)
    if not 0 < size <= CASE_BYTES - 8:
        return None
    try:
        return Case.from_json(notes[8 : 8 + size].decode("utf-8"))
    except (ValueError, TypeError, KeyError):
        return None
