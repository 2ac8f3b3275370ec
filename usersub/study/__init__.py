# SPDX-License-Identifier: MIT
"""Error against run time: what a law, a method, a step and a precision cost and give.

    from usersub.study import points, study

    found = study(points(["P2"], interfaces=["vfric"]), "results")
    for result in found.results:
        print(result.label, result.step, result.error, result.run_time_s)

Linear algebra of some problems runs on several threads if numpy was imported before; set
OPENBLAS_NUM_THREADS=1 then, as `usersub study` does.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub.study.grid import points as points
    from usersub.study.result import Point as Point
    from usersub.study.result import Result as Result
    from usersub.study.session import Study as Study
    from usersub.study.session import study as study

_HOME = {
    "Point": "result",
    "Result": "result",
    "Study": "session",
    "points": "grid",
    "study": "session",
}

__all__ = ["Point", "Result", "Study", "points", "study"]


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'usersub.study' has no attribute '{name}'")
    return getattr(importlib.import_module(f"usersub.study.{_HOME[name]}"), name)
