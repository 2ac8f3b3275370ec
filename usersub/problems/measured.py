# SPDX-License-Identifier: MIT
"""Errors of every problem by every method, through every interface: worst over the languages."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from usersub.problems import Case, Outcome, all_cases

#: Errors of an outcome that are told one by one; of the other problems it is the outcome's own.
_DETAILS = ("time_error", "distance_error")


@dataclass
class Measured:
    """One method of one problem through one interface.

    Attributes:
        tolerance: error that the method allows, by precision.
        errors: largest error over the languages, by precision and quantity.
        steps: increments until the block stands still; 0 for other problems.
        says: the answer in words, of the first run.
    """

    problem: str
    law: str
    interface: str
    method: str
    error_of: str
    steps: int
    says: str = ""
    tolerance: dict[str, float] = field(default_factory=dict)
    errors: dict[str, dict[str, float]] = field(default_factory=dict)

    def add(self, outcome: Outcome) -> None:
        """Takes one more language or precision into account."""
        worst = self.errors.setdefault(outcome.precision, {})
        self.tolerance[outcome.precision] = outcome.tolerance
        for name, error in _errors(outcome).items():
            before = worst.get(name, 0.0)
            worst[name] = error if math.isnan(error) else max(before, error)


def _errors(outcome: Outcome) -> dict[str, float]:
    named = {name: outcome.details[name] for name in _DETAILS if name in outcome.details}
    return named or {"error": outcome.error}


def measure(
    run: Callable[[Case], Outcome] = Case.run, cases: Iterable[Case] | None = None
) -> list[Measured]:
    """Runs all cases, or those given; takes some seconds and more where code has to be compiled.

    Raises:
        MissingTool: the compiler of a language is missing.
    """
    found: dict[tuple[str, ...], Measured] = {}
    for case in all_cases() if cases is None else cases:
        outcome = run(case)
        key = (case.problem, case.law, case.interface, case.method)
        if key not in found:
            stop = outcome.details.get("stopping_time", 0.0)
            steps = round(stop / outcome.step)
            found[key] = Measured(*key, outcome.error_of, steps, outcome.says)
        found[key].add(outcome)
    return list(found.values())
