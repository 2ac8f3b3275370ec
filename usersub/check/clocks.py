# SPDX-License-Identifier: MIT
"""Time that other processes have taken, and whether that is too much."""

from __future__ import annotations

import time

#: By the clock, a process may take this many times the time that it may compute.
_PATIENCE = 10.0


def processor_time(process: int) -> float | None:
    """Seconds that a process has computed so far, or None where the system does not tell."""
    try:
        return time.clock_gettime((~process << 3) | 2)  # as clock_getcpuclockid makes it
    except OSError:
        return None


def is_late(lived: float, computed: float, seconds: float) -> bool:
    """Whether a process is over its time: by what it has computed and, since the machine may be
    busy with other things, only much later by the clock."""
    return computed > 0.9 * seconds or lived > _PATIENCE * seconds
