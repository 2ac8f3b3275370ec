# SPDX-License-Identifier: MIT
"""Checks of names against what there is, with the nearest match in the message."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable

from usersub.errors import SceneError


def positive(problem: str, option: str, value: float | None, default: float) -> float:
    """The value of an option, or its default where there is none.

    Raises:
        SceneError: it is not a finite number above zero.
    """
    if value is None:
        return default
    if not (isinstance(value, float | int) and 0.0 < value < math.inf):
        raise SceneError(f"problem {problem}: {option} is {value!r}, expected a number above 0")
    return float(value)


def one_of(kind: str, given: Iterable[str], known: Iterable[str], of: str) -> str:
    """The last name of `given`, all of which have to be in `known`.

    Raises:
        SceneError: one is not; the message names the nearest and all that there are.
    """
    names = list(known)
    last = ""
    for name in given:
        if name not in names:
            near = difflib.get_close_matches(name, names, n=1, cutoff=0.4)
            hint = f"; did you mean '{near[0]}'?" if near else "."
            raise SceneError(
                f"problem {of} has no {kind} '{name}'{hint} "
                f"Expected one of: {', '.join(names) or 'none'}"
            )
        last = name
    return last
