# SPDX-License-Identifier: MIT
"""What the process reads and writes while a routine is called, on any unit, file or stream."""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import select
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from usersub.check.probing.raw import RawCall

_COUNTERS = Path("/proc/self/io")
#: Calls before the first measurement, and in each of the two that are compared.
_FIRST, _FEW, _MANY = 2, 8, 24


@dataclass(frozen=True)
class Traffic:
    """Bytes `read` and `written` a call, after the first calls."""

    read: float
    written: float


def of_calls(call: RawCall, seconds: float = 5.0) -> Traffic | None:
    """Calls the routine in a child process, again and again with the same arguments.

    Returns:
        what each call adds; None if the routine does not come back.
    """
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        try:
            with (
                contextlib.suppress(InterruptedError),
                tempfile.TemporaryDirectory(prefix="usersub-") as folder,
            ):
                os.write(writer, json.dumps(_measure(call, folder)).encode())
        finally:
            os._exit(0)
    os.close(writer)
    told = _read(reader, seconds)
    os.close(reader)
    with contextlib.suppress(ProcessLookupError):
        os.kill(child, 9)
    os.waitpid(child, 0)
    if not told:
        return None
    few, many = json.loads(told)
    # What a measurement itself reads is the same in both.
    each = [(b - a) / (_MANY - _FEW) for a, b in zip(few, many, strict=True)]
    return Traffic(*(max(0.0, value) for value in each))


def _read(reader: int, seconds: float) -> bytes:
    ready = select.select([reader], [], [], seconds)[0]
    return os.read(reader, 1 << 12) if ready else b""


def _measure(call: RawCall, folder: str) -> tuple[list[int], list[int]]:
    """Bytes read and written during a few calls, and during many."""
    from usersub.check.running import begin
    from usersub.routine import messages

    os.chdir(folder)
    begin.copy_files(Path(folder))
    sink = os.open("streams", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.dup2(sink, 1)
    os.dup2(sink, 2)
    sys.stdout = sys.stderr = open(1, "w", encoding="utf-8", closefd=False)
    # Messages of STDB_ABQERR and XPLB_ABQERR are the solver's, and warn of something.
    messages.connect()
    messages.messages_to(None)
    _repeat(call, _FIRST)
    results = []
    for calls in (_FEW, _MANY):
        before = _counters()
        _repeat(call, calls)
        after = _counters()
        read, written = (b - a for a, b in zip(before, after, strict=True))
        results.append([read, written])
    return results[0], results[1]


def _repeat(call: RawCall, times: int) -> None:
    for _ in range(times):
        call.restore()
        if call.run() < 0:  # what it says when it refuses is no output of every call
            raise InterruptedError("the routine raised an exception")
    _flush(call)


def _flush(call: RawCall) -> None:
    """Hands on what the run-time libraries hold back."""
    ctypes.CDLL(None).fflush(None)
    sys.stdout.flush()
    library = call.entry.keep
    if isinstance(library, ctypes.CDLL):
        with contextlib.suppress(AttributeError):
            library._gfortran_flush_i4(None)


def _counters() -> tuple[int, int]:
    """Bytes that this process has read and written so far."""
    values = dict(line.split(": ") for line in _COUNTERS.read_text().splitlines())
    return int(values["rchar"]), int(values["wchar"])
