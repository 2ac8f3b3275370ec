# SPDX-License-Identifier: MIT
"""How the errors of the problems fall when they are refined, and where there is nothing to fall.

A study runs one problem by one method through one interface, coarse to fine; the routine is the
shipped law in C, since the language changes nothing but rounding. Its rows carry the order that was
observed between each run and the one before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field

from usersub import problems
from usersub.problems.problem import Outcome

#: Increments of the rigid block by method; the coarsest at which the order can be told. The finest
#: Increments of the rigid block by method: past the first irregularities, above rounding.
_STEPS = {
    "rigid": (32, 64, 128, 256),
    "rigid rk4": (32, 64, 128, 256),
    "implicit": (32, 64, 128, 256),
    "implicit Romberg": (8, 16, 32, 64),
}

#: Orders that the methods have in theory; Romberg's four levels leave the error dt^8.
_ORDERS = {"rigid": 2.0, "rigid rk4": 4.0, "implicit": 2.0, "implicit Romberg": 8.0}

#: Increments where the answer is exact for any.
_ANY_STEPS = (1, 8, 64)
_ANY_BLOCK_STEPS = (8, 32, 128)
_FEW_STEPS = (1, 4, 16)

#: Runs from event to event that leave no elastic slip, and their increments.
_EVENTS = {"vfric_coef": "kinematic events", "fric_coef": "lagrange events"}
_EVENT_STEPS = (90, 157, 333)

#: Contact points: their number changes rounding alone.
_POINTS = 16

#: Intervals of the table between slip rates, and contact points enough to meet its worst places.
_INTERVALS = (80, 160, 320, 640)
_TABLE_SAMPLES = 1024

#: Refinements of P10 to P12, P19, P20, P22 and P23 by "points" or "steps", method and interface;
#: errors by their names in the details. The counts of P10 leave the same rest divided by three.
_REFINED = (
    ("P10", "coulomb", "fric", "penalty", "points", (16, 31, 61), ("force", "loop")),
    ("P11", "coulomb", "fric_coef", "lagrange", "points", (16, 32, 64),
     ("pulled", "released", "loop")),
    ("P12", "coulomb", "fric", "penalty", "points", (16, 32, 64), ("logarithm",)),
    ("P19", "orthotropic", "fric", "midpoint", "steps", (16, 32, 64), ("speed", "angle")),
    ("P19", "anisotropic", "fric_coef", "midpoint", "steps", (16, 32, 64), ("speed", "angle")),
    ("P20", "coulomb", "fric", "compliant", "steps", (200, 400, 800), ("force at 1e+06 N/m",)),
    ("P20", "coulomb", "vfric", "compliant", "steps", (200, 400, 800), ("force at 1e+06 N/m",)),
    ("P22", "coulomb", "fric_coef", "midpoint", "steps", (600, 1200, 2400), ("motion", "growth")),
    ("P22", "coulomb", "vfriction", "central differences", "steps", (600, 1200, 2400),
     ("motion", "growth")),
    ("P23", "coulomb", "vfric_coef", "central differences", "steps", (500, 1000, 2000),
     ("rough amplitude", "rough last turn")),
    ("P23", "coulomb", "fric_coef", "trapezoidal rule", "steps", (500, 1000, 2000),
     ("rough last turn",)),
)  # fmt: skip
_REFINED_ORDER = 2.0

#: The finite-element block: halvings of the time increment, and those of the run that the others
#: are compared with.
_HALVINGS = (0, 1, 2, 3)
_REFERENCE_HALVINGS = 5
_SHARE = 0.9

_TIME, _DISTANCE = "stopping time", "distance"

SMOOTH, IRREGULAR, EXACT = "smooth", "irregular", "exact"


@dataclass(frozen=True)
class Row:
    """One run of a study.

    Attributes:
        problem, law, interface, method: what was run.
        quantity: what the error is of.
        steps: increments, intervals of the table, or contact points of a refined problem.
        error: relative.
        order: observed since the coarser run; None for the first one and where the method is exact.
    """

    problem: str
    law: str
    interface: str
    method: str
    quantity: str
    steps: int
    error: float
    order: float | None

    def as_dict(self) -> dict[str, object]:
        """The row by the names of its columns."""
        return asdict(self)


@dataclass(frozen=True)
class Study:
    """Errors of one quantity, coarse to fine.

    Attributes:
        kind: SMOOTH, IRREGULAR (an order shows in the mean of all runs at most) or EXACT for any
            number of steps.
        expected: order of the method in theory, or None.
        steps, errors: of the runs.
        remains: where errors are against a refined run, its own against the exact answer; else nan.
    """

    problem: str
    law: str
    interface: str
    method: str
    quantity: str
    kind: str
    expected: float | None
    steps: tuple[int, ...]
    errors: tuple[float, ...]
    remains: float = field(default=math.nan)

    @property
    def rows(self) -> list[Row]:
        """One row a run."""
        orders = [None, *map(self._order, range(len(self.steps) - 1), range(1, len(self.steps)))]
        return [
            Row(self.problem, self.law, self.interface, self.method, self.quantity, *found)
            for found in zip(self.steps, self.errors, orders, strict=True)
        ]

    @property
    def order(self) -> float | None:
        """The order between the two finest runs, or in the mean of all; None without one."""
        last = len(self.steps) - 1
        if self.expected is None:
            return None
        return self._order(last - 1 if self.kind == SMOOTH else 0, last)

    def _order(self, coarse: int, fine: int) -> float | None:
        if self.kind == EXACT:
            return None
        ratio = self.errors[coarse] / self.errors[fine]
        return math.log(ratio) / math.log(self.steps[fine] / self.steps[coarse])


def rows() -> list[Row]:
    """Rows of all studies; takes some seconds."""
    return [row for study in studies() for row in study.rows]


def studies() -> Iterator[Study]:
    """All studies, one after another."""
    for interface, methods in problems.PROBLEMS["P1"].methods.items():
        for method in methods:
            if method in _STEPS:
                yield from _study("P1", interface, method, _ANY_BLOCK_STEPS, _BOTH, None)
    for interface, methods in problems.PROBLEMS["P2"].methods.items():
        for method in methods:
            if method in _STEPS:
                steps, order = _STEPS[method], _ORDERS[method]
                yield from _study("P2", interface, method, steps, _EACH, order)
    for name in ("P1", "P2"):
        for element in ("CPE3", "C3D8R"):
            yield from _finite_elements(name, element)
    yield from _study("P3", "fric", "prescribed traction", _ANY_STEPS, _WHOLE, None)
    for interface, methods in problems.PROBLEMS["P4"].methods.items():
        for method in methods:
            yield from _table(interface, method)
    for interface, methods in problems.PROBLEMS["P9"].methods.items():
        for method in methods:
            if "limit" not in method:  # which has no increments
                yield from _study("P9", interface, method, _FEW_STEPS, _FRICTION, None)
    for name in ("P5", "P6", "P7", "P8"):
        for interface, method in _EVENTS.items():
            yield from _study(name, interface, method, _EVENT_STEPS, _ALL, None)
    for refined in _REFINED:
        yield from _refined(*refined)


#: How the errors of an outcome are read, by what they are of.
_Errors = dict[str, Callable[[Outcome], float]]
_BOTH: _Errors = {f"{_TIME}, {_DISTANCE}": lambda outcome: outcome.error}
_ALL: _Errors = {"all numbers": lambda outcome: outcome.error}
_EACH: _Errors = {
    _TIME: lambda outcome: outcome.details["time_error"],
    _DISTANCE: lambda outcome: outcome.details["distance_error"],
}
_WHOLE: _Errors = {"slip, tangent": lambda outcome: outcome.error}
_FRICTION: _Errors = {"friction": lambda outcome: outcome.error}


def _study(
    name: str,
    interface: str,
    method: str,
    steps: tuple[int, ...],
    errors: _Errors,
    expected: float | None,
) -> Iterator[Study]:
    """Studies of one problem by its number of increments."""
    outcomes = [
        problems.run(
            name, interface=interface, language="c", method=method, steps=count, points=_POINTS
        )
        for count in steps
    ]
    for quantity, error in errors.items():
        found = tuple(error(outcome) for outcome in outcomes)
        law, kind = outcomes[0].law, EXACT if expected is None else SMOOTH
        yield Study(name, law, interface, method, quantity, kind, expected, steps, found)


def _refined(
    name: str, law: str, interface: str, method: str, option: str, counts: tuple[int, ...],
    errors: tuple[str, ...],
) -> Iterator[Study]:  # fmt: skip
    """Studies of one problem by an option that refines it."""
    outcomes = [
        problems.run(
            name, law=law, interface=interface, language="c", method=method, **{option: count}
        )
        for count in counts
    ]
    for key in errors:
        found = tuple(outcome.details[key] for outcome in outcomes)
        quantity = key.replace("_", " ")
        yield Study(name, law, interface, method, quantity, SMOOTH, _REFINED_ORDER, counts, found)


def _table(interface: str, method: str) -> Iterator[Study]:
    """The tabulated twin: its coefficient, and its derivative by the slip rate."""
    law = "coulomb_tabulated"
    outcomes = [
        problems.run(
            "P4", law=law, interface=interface, language="c", method=method,
            points=_TABLE_SAMPLES, table_points=intervals + 1,
        )
        for intervals in _INTERVALS
    ]  # fmt: skip
    for key, quantity, expected in (
        ("coefficient", "coefficient", 2.0), ("by_rate", "derivative by slip rate", 1.0),
    ):  # fmt: skip
        found = tuple(outcome.details[key] for outcome in outcomes)
        yield Study("P4", law, interface, method, quantity, SMOOTH, expected, _INTERVALS, found)


def _finite_elements(name: str, element: str) -> Iterator[Study]:
    """The elastic block stops a little off the rigid one: compared with its own refined run.

    Its mean velocity carries an elastic oscillation through zero, and sticking nodes switch between
    increments: only the distance of P2 shows the order of central differences, and in the mean.
    """
    outcomes = [
        problems.run(
            name, interface="vfric", language="c", method=element, step_share=_SHARE / 2**halvings
        )
        for halvings in (*_HALVINGS, _REFERENCE_HALVINGS)
    ]
    finest = outcomes.pop()
    steps = tuple(round(o.details["stopping_time"] / o.step) for o in outcomes)
    for key, exact, quantity in (
        ("stopping_time", "time_error", _TIME), ("distance", "distance_error", _DISTANCE),
    ):  # fmt: skip
        reference = finest.details[key]
        yield Study(
            name, finest.law, "vfric", element, quantity, IRREGULAR,
            2.0 if (name, key) == ("P2", "distance") else None, steps,
            tuple(abs(o.details[key] / reference - 1.0) for o in outcomes),
            remains=finest.details[exact],
        )  # fmt: skip
