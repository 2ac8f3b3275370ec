# SPDX-License-Identifier: MIT
"""The inside of a child process of `usersub.check.running.isolate`."""

from __future__ import annotations

import contextlib
import ctypes
import faulthandler
import gc
import json
import mmap
import os
import resource
import signal
import struct
import sys
import tempfile
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usersub.check.running import begin

if TYPE_CHECKING:
    from usersub.check.case import Case

#: Largest file that a child may write, bytes.
_LARGEST_FILE = 256 << 20
#: `mallopt`: memory is filled with the complement of this byte when it is given out, and with the
#: byte itself when it is given back, so that stale and unset values do not look like good ones.
_PERTURB, _FILL = -6, 0x5A
#: `prctl`: the signal that a process gets when its parent is gone.
_PARENT_GONE = 1
#: Sizes of memory that are asked for at the end, so that the C library looks at its books.
_SIZES = (24, 72, 200, 520, 1032, 4104, 20000, 100000)


class Channel:
    """What a child says to its parent, and the case that it is at.

    Attributes:
        case: the case that was told last.
        END: what is said last.
        STAGE: key of what is said at the beginning of a stage.
        OUTPUT: name of the file that the standard streams go to.
    """

    END = {"end": True}
    STAGE = "stage"
    OUTPUT = ".output"

    def __init__(self, writer: int, notes: mmap.mmap) -> None:
        self._writer, self._notes = writer, notes
        self.case: Case | None = None

    def say(self, what: dict[str, Any]) -> None:
        """Sends plain data (numpy arrays as lists)."""
        data = json.dumps(what, default=_plain).encode("utf-8") + b"\n"
        while data:
            data = data[os.write(self._writer, data) :]

    def fail(self, error: BaseException) -> None:
        """Sends what is left of an exception outside of its process."""
        whole = "".join(traceback.format_exception(error))
        kind = type(error).__name__
        self.say({"error": {"kind": kind, "words": str(error), "trace": whole}})

    def tell(self, case: Case) -> None:
        """Notes the case that is looked at from now on."""
        self.case = case
        data = json.dumps(case, default=vars).encode("utf-8")
        room = len(self._notes) - 8
        # A reader in between must not take half a case for a whole one.
        struct.pack_into("<Q", self._notes, 0, 0)
        if len(data) <= room:
            self._notes[8 : 8 + len(data)] = data
            struct.pack_into("<Q", self._notes, 0, len(data))

    def stage(self, key: str, seconds: float) -> None:
        """Begins a part of the work that has a time limit, cases and output of its own."""
        struct.pack_into("<Q", self._notes, 0, 0)
        self.case = None
        now = time.monotonic()
        self.say({self.STAGE: key, "seconds": seconds, "at": self.written(), "time": now})

    @staticmethod
    def written() -> int:
        """Bytes that this process has written to its standard streams so far."""
        ctypes.CDLL(None).fflush(None)
        sys.stdout.flush()
        sys.stderr.flush()
        return os.fstat(1).st_size


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, set | frozenset):
        return sorted(value)
    return str(value)


def enter(channel: Channel, work: Callable, home: Path, seconds: float) -> None:
    """Makes the process harmless, does the work, looks at the heap and ends. Never returns."""
    _settle(home, seconds)
    begin.in_child(home)
    try:
        work(channel)
    except BaseException as error:
        channel.fail(error)
    channel.say(Channel.END)
    _look_at_heap()
    with contextlib.suppress(Exception):
        channel.written()  # flushes
    os._exit(0)


def _settle(home: Path, seconds: float) -> None:
    """Own process group, folder and streams; limits; signals as at the start of a program."""
    with contextlib.suppress(OSError):
        os.setpgid(0, 0)
    gc.freeze()  # a collection would copy all that is shared with the parent
    # It puts back the handlers from before it was enabled, not ours from after that.
    faulthandler.disable()
    faulthandler.cancel_dump_traceback_later()
    _catch_faults_again()
    if threading.current_thread() is threading.main_thread():
        signal.set_wakeup_fd(-1)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM, signal.SIGCHLD, signal.SIGHUP):
        with contextlib.suppress(ValueError, OSError):
            signal.signal(number, signal.SIG_DFL)
    os.chdir(home)
    tempfile.tempdir = os.environ["TMPDIR"] = str(home)  # what stays there goes with the folder
    null = os.open(os.devnull, os.O_RDONLY)
    out = os.open(Channel.OUTPUT, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
    for source, target in ((null, 0), (out, 1), (out, 2)):
        os.dup2(source, target)
    # By lines, so that what was said before the end of a time limit is there.
    sys.stdout = open(1, "w", 1, encoding="utf-8", errors="replace", closefd=False)
    sys.stderr = open(2, "w", 1, encoding="utf-8", errors="replace", closefd=False)
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_FSIZE, _LARGEST_FILE)
    _limit(resource.RLIMIT_CPU, int(4 * seconds) + 300)  # for those that nobody waits for
    with contextlib.suppress(Exception):
        process = ctypes.CDLL(None)
        process.mallopt(_PERTURB, _FILL)
        process.prctl(_PARENT_GONE, signal.SIGKILL)
    # Where memory runs out, this process has to go and not its parent.
    with contextlib.suppress(OSError):
        Path("/proc/self/oom_score_adj").write_text("1000", encoding="ascii")


def _catch_faults_again() -> None:
    """Installs the handlers of the C core anew, where it had installed them."""
    from usersub.core import lib

    lib.usub_catch_faults(0)
    lib.usub_catch_faults(1)


def _limit(what: int, value: int) -> None:
    with contextlib.suppress(ValueError, OSError):
        hard = resource.getrlimit(what)[1]
        top = value if hard == resource.RLIM_INFINITY else min(value, hard)
        resource.setrlimit(what, (top, hard))


def _look_at_heap() -> None:
    """Makes the C library look at its books; it aborts if they are damaged."""
    with contextlib.suppress(AttributeError):
        process = ctypes.CDLL(None)
        process.malloc.restype, process.malloc.argtypes = ctypes.c_void_p, [ctypes.c_size_t]
        process.free.argtypes = [ctypes.c_void_p]
        for _ in range(2):
            taken = [process.malloc(size) for size in _SIZES for _ in range(12)]
            for place in taken:
                process.free(place)
            process.malloc_trim(0)
