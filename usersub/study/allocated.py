# SPDX-License-Identifier: MIT
"""How much memory the process has from the C library."""

from __future__ import annotations

import ctypes
import gc
import math
from collections.abc import Callable
from typing import TypeVar

Kept = TypeVar("Kept")


class _Mallinfo(ctypes.Structure):
    _fields_ = [
        (name, ctypes.c_size_t)
        for name in (
            "arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
            "fordblks", "keepcost",
        )
    ]  # fmt: skip


def growth(make: Callable[[], Kept]) -> tuple[Kept, float]:
    """What `make` gives, and the bytes that the process has more for it; nan as below.

    It is called twice: what is loaded and cached at the first time does not count.
    """
    make()
    enabled = gc.isenabled()
    gc.disable()  # what goes while we look would count as memory that was won
    try:
        before = allocated()
        kept = make()
        return kept, allocated() - before
    finally:
        if enabled:
            gc.enable()


def allocated() -> float:
    """Bytes that the process has allocated; nan where the C library does not tell."""
    try:
        tell = ctypes.CDLL(None).mallinfo2
    except (AttributeError, OSError):
        return math.nan
    tell.restype = _Mallinfo
    found = tell()
    return float(found.uordblks + found.hblkhd)
