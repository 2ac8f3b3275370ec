# SPDX-License-Identifier: MIT
"""Reports as one HTML page with figures, which needs nothing besides itself.

    from usersub.check.page import write
    write(reports, "report.html")

Figures need matplotlib (extra `report`), which is imported here only. They run the routines once
more, in processes of their own; where a routine crashes, a sentence stands in place of the figure.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from usersub.check.page.canvas import require
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.reports.report import Report

__all__ = ["page", "require", "write"]


def write(reports: Sequence[Report], path: str | Path) -> None:
    """Writes the page of the reports.

    Raises:
        MissingTool: matplotlib is missing.
        Error: the file cannot be written.
    """
    text = page(reports)
    try:
        Path(path).write_text(text, encoding="utf-8")
    except OSError as error:
        raise Error(f"{path}: cannot be written: {error.strerror}") from error


def page(reports: Sequence[Report]) -> str:
    """The page of the reports as text.

    Raises:
        MissingTool: matplotlib is missing.
    """
    require()
    from usersub.check.page.whole import whole

    return whole(reports)
