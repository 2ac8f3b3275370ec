# SPDX-License-Identifier: MIT
"""Stability: stiff and extreme cases through the real drivers, and limits beside their theory."""

from __future__ import annotations

from usersub.study.stability.cell import VERDICTS, Cell, Limit
from usersub.study.stability.measured import limits
from usersub.study.stability.whole import matrix

__all__ = ["VERDICTS", "Cell", "Limit", "limits", "matrix"]
