# SPDX-License-Identifier: MIT
"""All measured limits."""

from __future__ import annotations

from collections.abc import Callable

from usersub.study.stability import explicit_limits, implicit_limits, long_limits
from usersub.study.stability.cell import Limit

#: Largest relative distance from theory of a limit that has one.
WITHIN = 0.05


def limits(
    quick: bool = False, progress: Callable[[int, int, str], None] | None = None
) -> list[Limit]:
    """Measures the limits of drivers and shipped laws beside what theory says.

    Args:
        quick: shorter runs; holds and cycles of 2e4 increments in place of 1e7.
        progress: is told how many groups are done, how many there are, and which comes.

    Raises:
        MissingTool: no C compiler.
    """
    groups = (
        ("explicit steps", explicit_limits.all_of),
        ("Newton's method and uniqueness", implicit_limits.all_of),
        ("long holds and cycles", long_limits.all_of),
    )
    found: list[Limit] = []
    for done, (name, group) in enumerate(groups):
        if progress is not None:
            progress(done, len(groups), name)
        found += group(quick)
    if progress is not None:
        progress(len(groups), len(groups), "")
    return found
