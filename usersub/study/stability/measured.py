# SPDX-License-Identifier: MIT
"""All measured limits."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed

from usersub.study.stability import explicit_limits, implicit_limits, long_laws
from usersub.study.stability.cell import Limit

#: Largest relative distance from theory of a limit that has one.
WITHIN = 0.05


#: What is measured together, in the order of the page.
_GROUPS = (
    ("explicit steps", explicit_limits.all_of),
    ("Newton's method and uniqueness", implicit_limits.all_of),
    ("long cycles in double precision", long_laws.double_cycles),
    ("long cycles in single precision", long_laws.single_cycles),
    ("long holds", long_laws.core_holds),
    ("long cycles of laws", long_laws.cycles_one),
    ("long cycles of laws, the others", long_laws.cycles_two),
    ("long holds of laws", long_laws.holds_one),
    ("long holds of laws, the others", long_laws.holds_two),
)


def limits(
    quick: bool = False, progress: Callable[[int, int, str], None] | None = None, jobs: int = 1
) -> list[Limit]:
    """Measures the limits of drivers and shipped laws beside what theory says.

    Args:
        quick: shorter runs; holds and cycles of 2e4 increments in place of 1e7.
        progress: is told how many groups are done, how many there are, and which comes.
        jobs: processes at a time.

    Raises:
        MissingTool: no C compiler.
    """
    found: dict[int, list[Limit]] = {}
    if jobs > 1:
        with ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn")) as pool:
            # the longest first
            tasks = {pool.submit(_group, n, quick): n for n in reversed(range(len(_GROUPS)))}
            for task in as_completed(tasks):
                found[tasks[task]] = task.result()
                if progress is not None:
                    progress(len(found), len(_GROUPS), _GROUPS[tasks[task]][0])
    else:
        for n, (name, _) in enumerate(_GROUPS):
            if progress is not None:
                progress(n, len(_GROUPS), name)
            found[n] = _group(n, quick)
        if progress is not None:
            progress(len(_GROUPS), len(_GROUPS), "")
    return [limit for n in range(len(_GROUPS)) for limit in found[n]]


def _group(number: int, quick: bool) -> list[Limit]:
    return list(_GROUPS[number][1](quick))
