# SPDX-License-Identifier: MIT
"""What routines say: STDB_ABQERR, XPLB_ABQERR, and lines on Fortran units 6 and 7.

Units 6 and 7 of the whole process are connected to files without a name as soon as a routine is
loaded that writes to units, so that no `fort.7` appears in the working directory; after each driver
call the new lines go to the receiver.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path

from usersub.errors import SceneError
from usersub.routine import units

#: Gets a level and a text: 1 information, -1 warning, -2 error, -3 fatal, 0 a line on a unit.
Receiver = Callable[[int, str], None]

_PREFIX = {1: "", -1: "warning: ", -2: "error: ", -3: "fatal error: "}
_UNITS = (6, 7)
#: What a unit is connected to, by `usub_unit_flush`: nothing (0), our file, a file that the routine
#: opened, `fort.7` in the working directory.
_OWN, _OTHER, _LITTER = 1, 2, 3
#: A unit's file starts again at this size.
_LARGEST = 1 << 22


def _to_stderr(level: int, text: str) -> None:
    print(_PREFIX.get(level, "") + text, file=sys.stderr)


_receiver: Receiver | None = _to_stderr
_handler: object = None
_lock = threading.RLock()


def messages_to(receiver: Receiver | str | os.PathLike | None = _to_stderr) -> None:
    """Sets who gets what routines say; the setting holds for the process.

    Args:
        receiver: a function of level and text, a path to which lines are appended, or None to
            drop everything. Without an argument: lines on `sys.stderr`, as at the start.
    """
    global _receiver
    if not (receiver is None or callable(receiver) or isinstance(receiver, str | os.PathLike)):
        raise SceneError(
            f"messages_to got {receiver!r}; expected a function of level and text, a path or None"
        )
    after_call()
    if isinstance(receiver, str | os.PathLike):
        receiver = _appender(Path(receiver))
    _receiver = receiver
    connect()


def _appender(path: Path) -> Receiver:
    with path.open("a", encoding="utf-8"):
        pass  # a path that cannot be written is refused here, not in the middle of a run

    def append(level: int, text: str) -> None:
        with path.open("a", encoding="utf-8") as file:
            file.write(_PREFIX.get(level, "") + text + "\n")

    return append


def connect() -> None:
    """Connects the C core's messages to the receiver; any number of times."""
    global _handler
    if _handler is not None:
        return
    from usersub.core import ffi, lib

    def handle(_context, level, text):
        _say(level, ffi.string(text).decode("utf-8", "replace"))

    _handler = ffi.callback("void(void *, int32_t, const char *)", handle)
    lib.usub_set_message_handler(_handler, ffi.NULL)


def _say(level: int, text: str) -> None:
    if _receiver is not None:
        _receiver(level, text)


class _Unit:
    """One Fortran unit of the process, connected to a file that has no name any more."""

    def __init__(self, helper: ctypes.CDLL, number: int):
        self._helper, self._number = helper, number
        self._rest = b""
        self._open()

    def _open(self) -> None:
        self._handle, name = tempfile.mkstemp(prefix="usersub-unit-")
        self._path, self._at, self._owner = os.fsencode(name), 0, os.getpid()
        state = ctypes.c_int(0)
        self._helper.usub_unit_open(self._number, self._path, len(self._path), ctypes.byref(state))
        os.unlink(name)

    def lines(self) -> list[str]:
        """Lines that are new since the last time."""
        found = self._helper.usub_unit_flush(self._number, self._path, len(self._path))
        # As much as there is: a buffer of fixed size would have to hold the longest output.
        fresh = max(os.fstat(self._handle).st_size - self._at, 0)
        data = os.pread(self._handle, fresh, self._at)
        self._at += len(data)
        if found == _OWN and self._owner == os.getpid():
            if self._at > _LARGEST:
                self._helper.usub_unit_again(self._number)
                os.ftruncate(self._handle, 0)
                self._at = 0
        elif found != _OTHER:
            # The routine closed the unit (and perhaps wrote on), or this is a forked child.
            if found == _LITTER:
                data += Path(f"fort.{self._number}").read_bytes()
                self._helper.usub_unit_delete(self._number)
            os.close(self._handle)
            self._open()
        *whole, self._rest = (self._rest + data).split(b"\n")
        return [line.decode("utf-8", "replace") for line in whole]


_units: list[_Unit] = []


def connect_units(loaded: ctypes.CDLL) -> None:
    """Connects units 6 and 7 of gfortran's run-time library; once, before `loaded` writes to them.

    Raises:
        MissingTool, CompileError: the few lines of Fortran that do it cannot be compiled.
    """
    with _lock:
        if not _units:
            helper = ctypes.CDLL(str(units.connector()), mode=os.RTLD_LOCAL | os.RTLD_NOW)
            _units.extend(_Unit(helper, number) for number in _UNITS)
            atexit.register(after_call)


def after_call() -> None:
    """Hands new lines on units 6 and 7 to the receiver; what a routine with output gives to
    `Routine.after_call`."""
    with _lock:
        for unit in _units:
            for line in unit.lines():
                _say(0, line)
