# SPDX-License-Identifier: MIT
"""Linear algebra on one thread: it would share cores with what is timed, and sum in another order
on another number of them. Standard library only, so that this comes before numpy."""

from __future__ import annotations

import os

#: Read by the libraries of linear algebra when numpy is imported.
NAMES = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


def one_thread() -> None:
    """For this process and its children, unless the user says otherwise."""
    for name in NAMES:
        os.environ.setdefault(name, "1")
