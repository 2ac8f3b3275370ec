# SPDX-License-Identifier: MIT
"""Ctrl-C while a routine does not return."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time

#: Seconds that the main thread has to end by itself, as it does unless compiled code keeps it.
PATIENCE = 2.0
#: Exit code of a process that was interrupted, as shells give it.
INTERRUPTED = 128 + signal.SIGINT
_SHOW_CURSOR = "\x1b[?25h"


def end_when_interrupted() -> None:
    """Makes Ctrl-C end the process even if a compiled routine never returns to the interpreter.

    Python itself acts on a signal between two of its own instructions only. Here the signal also
    wakes a thread, which runs because drivers free the GIL in their calls.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    wake, signalled = os.pipe()
    os.set_blocking(signalled, False)
    signal.set_wakeup_fd(signalled, warn_on_full_buffer=False)
    threading.Thread(target=_watch, args=(wake,), daemon=True).start()


def _watch(wake: int) -> None:
    while os.read(wake, 1) != bytes([signal.SIGINT]):
        pass
    time.sleep(PATIENCE)
    if sys.stderr.isatty():
        sys.stderr.write(_SHOW_CURSOR)  # progress hides it
    sys.stderr.write("\nusersub: interrupted in a routine that does not return\n")
    sys.stderr.flush()
    os._exit(INTERRUPTED)
