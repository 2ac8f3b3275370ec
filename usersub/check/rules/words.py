# SPDX-License-Identifier: MIT
"""What rules say: values and places of answers in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from usersub.check.respond.answer import Answer, different


def number(value: float) -> str:
    """A number with all the digits that tell it from its neighbours, short where it can be."""
    short = f"{value:.6g}"
    return short if float(short) == value else repr(float(value))


def value_at(answer: Answer, name: str, point: int) -> str:
    """The value of one array of an answer at a point, in words."""
    if name == "pnewdt":
        return "none" if answer.pnewdt is None else number(answer.pnewdt)
    return values(getattr(answer, name)[..., point])


def told_apart(one: Answer, other: Answer, name: str, point: int) -> tuple[str, str]:
    """The values of one array of two answers at a point, with the digits that tell them apart."""
    if name == "pnewdt":
        return value_at(one, name, point), value_at(other, name, point)
    pair = [np.asarray(getattr(a, name)[..., point], dtype=float).ravel("F") for a in (one, other)]
    largest = max((float(abs(v)) for a in pair for v in a if np.isfinite(v)), default=0.0)
    for digits in (4, 6, 9, 12):
        # What is left of turning the axes is told as zero, unless that is the difference.
        texts = [
            [f"{0.0 if abs(v) <= 1e-13 * largest else v:.{digits}g}" for v in array]
            for array in pair
        ]
        if texts[0] != texts[1]:
            one_text, other_text = (t[0] if len(t) == 1 else f"({', '.join(t)})" for t in texts)
            return one_text, other_text
    return value_at(one, name, point), value_at(other, name, point)


def values(array: np.ndarray | Sequence[float] | float) -> str:
    """Numbers in words: a single one as it is, several in brackets."""
    flat = np.asarray(array).ravel(order="F")
    if flat.size == 1:
        return number(float(flat[0]))
    return "(" + ", ".join(number(float(v)) for v in flat) + ")"


def first_unlike(
    ones: Sequence[Answer], others: Sequence[Answer], skip: tuple[str, ...] = ()
) -> tuple[int, str, int] | None:
    """Step, name and point of the first difference of bits; None if there is none."""
    for step, (one, other) in enumerate(zip(ones, others, strict=False)):
        found = different(one, other, skip)
        if found is not None:
            return step, *found
    return None


def failed(answers: Sequence[Answer]) -> str:
    """Why the last step failed, or ""."""
    failure = answers[-1].failure
    return "" if failure is None else str(failure)
