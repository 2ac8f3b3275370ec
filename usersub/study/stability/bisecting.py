# SPDX-License-Identifier: MIT
"""Where something stops being stable, by bisection."""

from __future__ import annotations

import math
from collections.abc import Callable

#: Width at which a limit is known well enough, relative.
CLOSE = 1e-3


def limit(stable: Callable[[float], bool], guess: float, reach: float = 8.0) -> float:
    """The largest value at which `stable` still holds, near `guess`; infinite if it always does.

    Args:
        reach: how far from the guess it is looked for, as a factor.
    """
    low, high = guess / reach, guess * reach
    if not stable(low):
        return 0.0
    if stable(high):
        return math.inf
    while high / low > 1.0 + CLOSE:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return math.sqrt(low * high)
