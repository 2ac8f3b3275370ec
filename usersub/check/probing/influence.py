# SPDX-License-Identifier: MIT
"""Whether what a routine is given makes a difference to what it answers."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from usersub.check.respond.answer import Answer, different
from usersub.check.subjects import values

if TYPE_CHECKING:
    from usersub.check.subject import Subject


def same(one: list[Answer], other: list[Answer]) -> bool:
    """Whether two runs of a case gave the same bits."""
    return len(one) == len(other) and not any(
        different(a, b) or (a.failure is None) != (b.failure is None)
        for a, b in zip(one, other, strict=True)
    )


def state_matters(subject: Subject, index: int) -> bool:
    """Whether a state variable is written, or what it is at the start changes an answer."""
    case = values.path_case()
    present = values.answers(subject, case)
    if any(a.state is not None and a.state[index].any() for a in present):
        return True
    start = tuple(0.125 if k == index else 0.0 for k in range(subject.states))
    other = values.answers(subject, case.but(state=start))
    if any(a.state is not None and (a.state[index] != 0.125).any() for a in other):
        return True
    return any(different(a, b, skip=("state",)) for a, b in zip(present, other, strict=False))


def field_matters(subject: Subject, index: int) -> bool:
    """Whether another value of a field variable changes an answer."""
    case = values.path_case()
    base = list(subject.scales.fields or (0.5,) * subject.fields)
    present = values.answers(subject, case)
    base[index] += 0.25
    moved = subject.but(scales=replace(subject.scales, fields=tuple(base)))
    return not same(present, values.answers(moved, case))
