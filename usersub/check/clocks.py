# SPDX-License-Identifier: MIT
"""Time that other processes have taken."""

from __future__ import annotations

import time


def processor_time(process: int) -> float | None:
    """Seconds that a process has computed so far, or None where the system does not tell."""
    try:
        return time.clock_gettime((~process << 3) | 2)  # as clock_getcpuclockid makes it
    except OSError:
        return None
