# SPDX-License-Identifier: MIT
"""Derivatives of answers by differences: a sweep of steps whose plateau is the derivative."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

#: Steps over the scale of the quantity that changes.
_SWEEP = tuple(10.0**-k for k in range(2, 10))
#: Steps so small that a smooth answer is a straight line, and no multiples of each other.
_NEXT = (2.7e-8, 7.1e-8, 1.3e-7, 3.1e-7, 7.7e-7)
_EPSILON = 4.0 * float(np.finfo(float).eps)
#: Difference of one-sided differences, over the derivative, that may mean a kink.
_KINK = 1e-7
#: How much of it is left when the step is a tenth.
_STAYS = 0.3


@dataclass(frozen=True)
class Derivative:
    """Derivative of each component of an answer.

    Attributes:
        value: central differences on their best plateau.
        doubt: how much neighbouring steps differ there.
        kink: whether the differences from above and from below are two.
    """

    value: np.ndarray
    doubt: np.ndarray
    kink: np.ndarray


def derivative(answer: Callable[[float], np.ndarray], scale: float) -> Derivative:
    """Derivative of `answer(step)` at step zero; `scale` is the size of what changes."""
    here = answer(0.0)
    middle, above, below = [], [], []
    for part in _SWEEP:
        h = part * scale
        up, down = answer(h), answer(-h)
        middle.append((up - down) / (2.0 * h))
        above.append((up - here) / h)
        below.append((here - down) / h)
    central = np.array(middle)
    noise = np.maximum(_noise(answer, scale), _EPSILON * np.abs(here))
    # shape (steps, ...): what noise makes of a difference
    steps = (scale * np.array(_SWEEP)).reshape(-1, *(1,) * here.ndim)
    change = np.abs(np.diff(central, axis=0)) + noise / steps[1:]
    best = np.argmin(change, axis=0)
    pick = np.indices(best.shape)
    value, doubt = central[(best, *pick)], change[(best, *pick)]
    rounding = _EPSILON * np.abs(here) / steps.ravel()[best + 1]
    apart = np.abs(np.array(above) - np.array(below))
    coarse, fine = apart[(best, *pick)], apart[(best + 1, *pick)]
    # between two tangents the gap stays, on a curve it shrinks with the step
    kink = (fine > _STAYS * coarse) & (fine > 10.0 * rounding) & (fine > _KINK * np.abs(value))
    return Derivative(value, doubt, kink)


def _noise(answer: Callable[[float], np.ndarray], scale: float) -> np.ndarray:
    """How far answers close by are from a straight line: single precision shows itself."""
    widths = 2.0 * scale * np.array(_NEXT)
    gaps = np.array([answer(0.5 * w) - answer(-0.5 * w) for w in widths])
    slope = np.tensordot(widths, gaps, axes=1) / np.sum(widths**2)
    return np.max(np.abs(gaps - np.multiply.outer(widths, slope)), axis=0)
