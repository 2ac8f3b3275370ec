# SPDX-License-Identifier: MIT
"""Measured values in words: eight digits, since what is measured here is compared, not repeated."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def number(value: float) -> str:
    """A number with at most eight digits."""
    return f"{float(value):.8g}"


def values(array: np.ndarray | Sequence[float] | float) -> str:
    """Numbers in words: a single one as it is, several in brackets; rounding errors are zeros."""
    flat = np.asarray(array, dtype=float).ravel(order="F")
    largest = np.max(np.abs(flat), initial=0.0)
    shown = [number(v if not abs(v) <= 1e-14 * largest else 0.0) for v in flat]
    return shown[0] if len(shown) == 1 else f"({', '.join(shown)})"
