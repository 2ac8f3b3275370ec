# SPDX-License-Identifier: MIT
"""Properties and histories at which a routine is compared with a built-in law: drawn over all
decades from a fixed seed, at the bounds of the properties and at the values that stand in them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.errors import Error
from usersub.laws.values import unflat

if TYPE_CHECKING:
    from usersub.check.subject import Subject
    from usersub.laws.description import Law
    from usersub.laws.parts import Prop

#: Draws of properties, and histories for each.
DRAWS, HISTORIES = 50, 3
#: Draws of properties at which formulas simplify.
CORNERS = 24
#: Most points of an axis of a table, field variables of a table, and elements of a law.
_AXIS, _FIELDS = 3, 2
#: Decade of extreme motions, by precision: with what is drawn around it, no input overflows.
_EXTREME = {"double": 304.0, "single": 34.0}
#: Least time increment of extreme motions.
_LONG = 64.0


# Properties.


def props(law: Law, seed: int = 1, draws: int = DRAWS) -> Iterator[tuple[float, ...]]:
    """Lists of properties that the law allows: its example first, then what is drawn."""
    yield law(**law.example).props
    yield from _several(law, _drawn, np.random.default_rng(seed), draws)


def corners(law: Law, seed: int = 1, draws: int = CORNERS) -> Iterator[tuple[float, ...]]:
    """Lists of properties that are all special: at a bound, one, or as in the example. A branch may
    be taken only where several of them meet."""
    yield from dict.fromkeys(_several(law, _special, np.random.default_rng(seed), draws))


def _several(
    law: Law,
    draw: Callable[[Law, Prop, np.random.Generator], float],
    random: np.random.Generator,
    draws: int,
) -> Iterator[tuple[float, ...]]:
    for _ in range(draws if law.props else 0):
        values: dict[str, Any] = {
            p.name: draw(law, p, random) for p in law.props if p.given and not p.shape
        }
        values |= _arrays(law, random)
        _order(law, values)
        try:
            yield law(**values).props
        except Error:  # a combination that the law refuses
            continue


def _drawn(law: Law, prop: Prop, random: np.random.Generator) -> float:
    """One number in its range: near the example, at a bound, one, or anywhere."""
    within = prop.range
    if within.choices:
        return float(random.choice(within.choices))
    known: Any = law.example.get(prop.name, prop.default)
    size = abs(float(known)) if isinstance(known, int | float) and known else 1.0
    sign = 1.0 if isinstance(known, int | float) and known >= 0 else -1.0
    way = random.uniform()
    if way < 0.12 and within.at_least is not None:
        return float(within.at_least)
    if way < 0.16 and within.at_most is not None:
        return float(within.at_most)
    value = sign * size * 10.0 ** random.uniform(-1.0, 1.0) if way < 0.9 else -sign * size
    if 0.16 <= way < 0.22 and within.allows(1.0):
        value = 1.0  # an exponent or a share at which formulas simplify
    if within.whole:
        value = float(round(value))
    if not within.allows(value):
        low = max(b for b in (within.at_least, within.above, 0.0) if b is not None)
        highs = [b for b in (within.at_most, within.below) if b is not None]
        value = random.uniform(low, min(highs)) if highs else low + abs(value) + 0.1
    return float(value)


def _special(law: Law, prop: Prop, random: np.random.Generator) -> float:
    within = prop.range
    if within.choices:
        return float(random.choice(within.choices))
    known: Any = law.example.get(prop.name, prop.default)
    found = [x for x in (within.at_least, within.at_most) if x is not None]
    found += [1.0] if within.allows(1.0) else []
    found += [float(known)] if isinstance(known, int | float) and within.allows(known) else []
    return float(random.choice(found)) if found else _drawn(law, prop, random)


def _order(law: Law, values: dict[str, Any]) -> None:
    """Temperatures of a law keep the order that they have in its example."""
    names = [p.name for p in law.props if p.unit == "temperature" and not p.shape]
    names = [n for n in names if n in law.example]
    example: dict[str, Any] = dict(law.example)
    ranks = sorted(names, key=lambda n: example[n])
    for name, value in zip(ranks, sorted(values[n] for n in names), strict=True):
        values[name] = value


def _arrays(law: Law, random: np.random.Generator) -> dict[str, object]:
    """All arrays of a law, with lengths of their own."""
    found: dict[str, object] = {}
    known: dict[str, object] = {}
    for prop in law.props:
        if prop.size_of:
            low, high = (0, _FIELDS) if _lists(law, prop) else (1, _AXIS)
            known[prop.name] = int(random.integers(low, high + 1))
        elif prop.sizes_of:
            count = int(known[law_size(law, prop)])  # type: ignore[call-overload]
            known[prop.name] = tuple(int(n) for n in random.integers(1, _AXIS + 1, count))
        elif prop.lists:
            sizes = known[next(p.name for p in law.props if p.sizes_of == prop.name)]
            found[prop.name] = [_axis(prop, n, random) for n in sizes]  # type: ignore[attr-defined]
        elif prop.shape:
            extents = prop.extents(known)
            count = int(np.prod(extents))
            flat = _axis(prop, count, random) if prop.ascending else _many(law, prop, count, random)
            found[prop.name] = unflat(flat, extents)
    return found


def law_size(law: Law, prop: Prop) -> str:
    """Name of the property that counts the entries of `prop`, an array of sizes."""
    return next(p.name for p in law.props if p.size_of == prop.sizes_of)


def _lists(law: Law, prop: Prop) -> bool:
    return any(p.lists and p.name == prop.size_of for p in law.props)


def _axis(prop: Prop, count: int, random: np.random.Generator) -> list[float]:
    """Ascending numbers in a decade of their own; powers of two, so that times are exact."""
    size = 2.0 ** random.integers(-6, 8)
    steps = np.cumsum(random.integers(1, 5, count))
    start = 0 if random.uniform() < 0.5 else steps[0]
    return [float(x) for x in size * (steps - start)]


def _many(law: Law, prop: Prop, count: int, random: np.random.Generator) -> list[float]:
    if prop.ascending or prop.name.startswith("table"):
        return [float(x) for x in random.uniform(0.01, 1.0, count)]
    example: Any = law.example.get(prop.name, prop.default)
    sizes = [float(x) for x in np.ravel(example)] if np.size(example) else [1.0]
    return [float(sizes[k % len(sizes)] * 10.0 ** random.uniform(-0.5, 0.5)) for k in range(count)]


# Histories.


def histories(
    subject: Subject, law: Law, values: Sequence[float], seed: int, count: int = HISTORIES
) -> Iterator[Case]:
    """Cases of up to three points with properties `values`, drawn over all decades."""
    random = np.random.default_rng(seed)
    for number in range(count):
        directions = 2 if number % 3 or subject.interface.name == "vfriction" else 1
        contact = cases.contacts(subject)[number % len(cases.contacts(subject))]
        points = 1 + number % 3
        steps = _steps(subject, law, values, points, directions, random)
        yield Case(tuple(steps), contact=contact, props=tuple(float(v) for v in values))


def with_rest(subject: Subject, law: Law, values: Sequence[float], seed: int) -> Case:
    """A case with properties `values` in which every second increment is one of rest,
    and all of them take time."""
    steps = list(_steps(subject, law, values, 2, 2, np.random.default_rng(seed)))
    for index, step in enumerate(steps):
        still = tuple((0.0,) * len(m) for m in step.motion)
        steps[index] = replace(
            step, dt=step.dt or steps[0].dt, motion=step.motion if index % 2 else still
        )
    return Case(tuple(steps), props=tuple(float(v) for v in values))


def extremes(subject: Subject, law: Law, values: Sequence[float], seed: int = 1) -> Iterator[Case]:
    """A case with properties `values` and motions near the end of the numbers: what is a sum or a
    product of theirs on the way to the answer must not overflow."""
    random = np.random.default_rng(seed)
    decade = _EXTREME[subject.precision]
    motion = 10.0 ** random.uniform(decade - 1, decade)
    # Times such that slip rates do not overflow: nobody could pass these on.
    steps = [
        replace(step, dt=max(step.dt, _LONG))
        for step in _steps(subject, law, values, 2, 2, random, motion)
    ]
    yield Case(tuple(steps), props=tuple(float(v) for v in values))


def _steps(
    subject: Subject,
    law: Law,
    values: Sequence[float],
    points: int,
    directions: int,
    random: np.random.Generator,
    motion: float = 0.0,
) -> Iterator[Step]:
    """Six increments: the points come to touch, then move as it comes."""
    heat = "temperature" in law.reads and random.uniform() < 0.8
    fields = _field_count(law, values) if random.uniform() < 0.9 else 0
    nodes = [abs(v) for v in values if v and np.isfinite(v) and 1e-12 < abs(v) < 1e12]
    motion = motion or 10.0 ** random.uniform(-8, 2)
    load = 10.0 ** random.uniform(-2, 4)
    step = 2.0 ** random.integers(-8, 6)
    still = ((0.0,) * directions,) * points
    for number in range(6):
        moved = tuple(_motion(motion, directions, random) for _ in range(points))
        loads = tuple(_load(load, nodes, random) for _ in range(points))
        # An increment without time: rates are those at rest.
        dt = 0.0 if random.uniform() < 0.04 else float(step * 2.0 ** random.integers(-1, 2))
        if random.uniform() < 0.2 and nodes and dt:
            rate = float(random.choice(nodes))
            moved = tuple((rate * dt, 0.0)[:directions] for _ in range(points))
        warm = tuple(_pair(nodes, random) for _ in range(points)) if heat else None
        around = tuple(_fields(fields, nodes, random) for _ in range(points)) if fields else None
        stick = None
        if subject.interface.solver == "explicit" and random.uniform() < 0.2:
            stick = tuple(float(abs(p) * 10.0 ** random.uniform(-2, 0)) for p in loads)
        first = number == 0
        yield Step(
            still if first else moved,
            tuple(abs(p) + 1e-3 for p in loads) if first else loads,
            dt or step if first else dt,
            stick=stick,
            temperature=warm,
            fields=around,
            iterations=2 if number == 3 and subject.interface.name == "fric" else 1,
        )


def _motion(size: float, directions: int, random: np.random.Generator) -> tuple[float, ...]:
    if random.uniform() < 0.08:
        return (0.0,) * directions
    length, angle = size * 10.0 ** random.uniform(-1.5, 1.5), random.uniform(0.0, 2.0 * np.pi)
    return tuple(float(length * c) for c in (np.cos(angle), np.sin(angle))[:directions])


def _load(size: float, nodes: Sequence[float], random: np.random.Generator) -> float:
    way = random.uniform()
    if way < 0.06:
        return 0.0
    value = float(size * 10.0 ** random.uniform(-1.0, 1.0))
    if way < 0.12:
        return -value
    return float(random.choice(nodes)) if way < 0.25 and nodes else value


def _pair(nodes: Sequence[float], random: np.random.Generator) -> tuple[float, float]:
    """Temperatures of both surfaces, their mean at a value of the properties or anywhere."""
    if random.uniform() < 0.3 and nodes:
        mean = float(random.choice(nodes))
        return mean, mean
    size = 10.0 ** random.uniform(0.0, 3.3)
    return float(size * random.uniform(0.2, 1.0)), float(size * random.uniform(0.2, 1.0))


def _field_count(law: Law, values: Sequence[float]) -> int:
    """Field variables that a table with these properties has, and one more."""
    if "fields" not in law.reads:
        return 0
    counted = next(p for p in law.props if p.size_of == "fields")
    known = law.values(values)[counted.name]
    return int(known) + 1  # type: ignore[call-overload]


def _fields(
    count: int, nodes: Sequence[float], random: np.random.Generator
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    one = tuple(float(2.0 ** random.uniform(-7, 9)) for _ in range(count))
    two = tuple(float(2.0 ** random.uniform(-7, 9)) for _ in range(count))
    if random.uniform() < 0.3 and nodes:
        one = two = tuple(float(random.choice(nodes)) for _ in range(count))
    return one, two
