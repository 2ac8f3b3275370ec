# SPDX-License-Identifier: MIT
"""What a problem with a known answer is, and what one run of it gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from usersub.routine.routine import Routine

#: The keys of one result, in their order.
KEYS = (
    "problem", "law", "interface", "language", "precision", "method", "step", "points", "error",
    "error_of", "run_time_s", "ns_per_point",
)  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """One run against the exact answer.

    Attributes:
        problem, law, interface, language, precision, method: what was run.
        step: largest time increment, in seconds.
        points: contact points a call.
        error: largest relative error of what `error_of` names.
        error_of: the compared quantities, in words.
        run_time_s: wall time of the run, without compilation.
        ns_per_point: time of the median driver call over its contact points, in nanoseconds.
        tolerance: the error that the method allows.
        details: more numbers: orders of convergence, Newton iterations, errors one by one.
        says: the answer in words where no number is one ("no solution", "two solutions").
        history: arrays against time, by name, for files and figures.
    """

    problem: str
    law: str
    interface: str
    language: str
    precision: str
    method: str
    step: float
    points: int
    error: float
    error_of: str
    run_time_s: float
    ns_per_point: float
    tolerance: float
    details: Mapping[str, float] = field(default_factory=dict)
    says: str = ""
    history: Mapping[str, np.ndarray] | None = field(default=None, repr=False, compare=False)

    @property
    def ok(self) -> bool:
        """Whether the error is within the tolerance (NaN is not)."""
        return self.error <= self.tolerance

    def as_dict(self) -> dict[str, object]:
        """The result under exactly the keys of `KEYS`."""
        return {key: getattr(self, key) for key in KEYS}


@dataclass(frozen=True)
class Problem:
    """A problem with a known answer.

    Attributes:
        name: "P1", ...
        title: one line.
        statement: what is given and what is asked for.
        laws: laws it is for; the first is the default.
        interfaces: interfaces through which it runs.
        methods: hosts and time integrations by interface; the first is the default.
        runner: `runner(routine, law, precision, method, **options) -> Outcome`.
        options: further options of the runner and what they mean.
        laws_by_interface: laws of interfaces that do not take all of `laws`.
        updates: by law and method, other updates of its state than its own, for the option
            `update`: routines of the problem's own (`usersub.problems.own`).
    """

    name: str
    title: str
    statement: str
    laws: tuple[str, ...]
    methods: Mapping[str, tuple[str, ...]]
    runner: Callable[..., Outcome] = field(repr=False)
    options: Mapping[str, str] = field(default_factory=dict)
    laws_by_interface: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    updates: Mapping[str, Mapping[str, tuple[str, ...]]] = field(default_factory=dict)

    def laws_of(self, interface: str) -> tuple[str, ...]:
        """Laws that the problem runs through an interface; the first is the default."""
        return self.laws_by_interface.get(interface, self.laws)

    @property
    def interfaces(self) -> tuple[str, ...]:
        """Interfaces through which the problem runs."""
        return tuple(self.methods)

    def run(
        self,
        routine: Routine,
        *,
        law: str | None = None,
        precision: str = "double",
        method: str | None = None,
        **options: object,
    ) -> Outcome:
        """Runs the problem through a routine that holds `law`.

        Raises:
            SceneError: interface, method or option does not fit the problem.
            RoutineError: the routine failed.
        """
        from usersub.problems.choose import one_of

        one_of("option", options, self.options, self.name)
        interface = one_of("interface", [routine.interface.name], self.methods, self.name)
        known = self.laws_of(interface)
        law = one_of("law", [law or known[0]], known, self.name)
        methods = self.methods[interface]
        method = one_of("method", [method or methods[0]], methods, f"{self.name} by {interface}")
        precisions = routine.interface.precisions
        one_of("precision", [precision], precisions, f"{self.name} by {interface}")
        return self.runner(routine, law, precision, method, **options)


class Stopwatch:
    """Takes the times of driver calls; made when everything is compiled."""

    def __init__(self) -> None:
        self._calls: list[float] = []
        self._start = perf_counter()

    def __enter__(self) -> None:
        self._entered = perf_counter()

    def __exit__(self, *_: object) -> None:
        self._calls.append(perf_counter() - self._entered)

    def times(self, points: int) -> dict[str, float]:
        """`run_time_s` since the stopwatch was made; `ns_per_point` of the median call."""
        return {
            "run_time_s": perf_counter() - self._start,
            "ns_per_point": 1e9 * median(self._calls) / points,
        }
