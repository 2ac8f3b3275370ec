# SPDX-License-Identifier: MIT
"""Findings at properties that nobody gave: whether they show at others as well.

What breaks a tangent or creates energy may be a combination that no surface has, such as a
softening steeper than the stiffness. Then the routine is not wrong, but its author has to look.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.rule import PASS, Rule
from usersub.check.running import isolate, verdicts
from usersub.check.running.look import look
from usersub.check.subjects.values import CHOSEN

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: Groups of rules that depend on what the properties mean.
GROUPS = ("tangent", "energy")
#: Lists of properties that are tried, and the decades by which they differ from those chosen.
_LISTS, _DECADES = 8, 1.0


def are_chosen(subject: Subject) -> bool:
    """Whether the properties were chosen by the checker."""
    return CHOSEN in subject.origin.get("props", "")


def harmless(subject: Subject, rule: Rule, seconds: float) -> tuple[float, ...] | None:
    """Other properties with which the routine passes the rule; None if there are none among those
    that are tried."""
    for props in _others(subject.props):
        outcome = isolate.run(partial(look, rule, subject.but(props=props)), seconds)
        passed = verdicts.says_something(outcome) and verdicts.death_of(outcome) is None
        if passed and verdicts.result_of(rule, outcome).verdict == PASS:
            return props
    return None


def _others(props: tuple[float, ...]) -> Iterator[tuple[float, ...]]:
    """The properties times numbers around one; whole numbers, which may count something, stay as
    they are every second time."""
    random = np.random.default_rng(len(props))
    for number in range(_LISTS):
        factors = 10.0 ** random.uniform(-_DECADES, _DECADES, len(props))
        yield tuple(
            p if number % 2 and p == round(p) else float(f"{p * f:.2g}")
            for p, f in zip(props, factors, strict=True)
        )
