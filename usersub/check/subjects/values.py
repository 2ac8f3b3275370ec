# SPDX-License-Identifier: MIT
"""Values of properties at which a routine does something: tried one after the other, no guessing.

What makes values good: the friction is finite, along the motion, and at some slip between a
fiftieth and about once the pressure; then every property should matter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.case import Case, Step
from usersub.check.respond import Answer, respond, run_of
from usersub.check.respond.answer import different
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: First values: falling, so that a static coefficient comes before a kinetic one.
FIRST = (0.3, 0.2, 0.1, 0.05, 0.4, 0.25, 0.15, 0.08, 0.35, 0.12)
#: What is tried for one property after the other.
TRIED = (1.0, 0.3, 10.0, 1e-2, 100.0, 1e-3, 2.0, 1e3, 1e4, 0.0, 1e-4, 1e6)

#: How it is told that nobody gave the properties.
CHOSEN = "values chosen"

#: Bounds of friction over load between which it is ordinary.
_LOW, _HIGH = 0.05, 1.2
#: Cost of friction that is ordinary but for its sign.
AGAINST = 0.5
#: (motion, load, time increment) of the probes; each begins from rest.
_PROBES = ((1e-6, 1.0, 0.25), (1e-3, 1.0, 0.25), (0.1, 1.0, 0.25), (10.0, 1.0, 0.25),
           (1e3, 10.0, 0.25), (1e-2, 10.0, 1e-3))  # fmt: skip


def first(count: int) -> tuple[float, ...]:
    """First values of so many properties."""
    return tuple(FIRST[k % len(FIRST)] for k in range(count))


def probe_case(subject: Subject, motion: float, load: float, dt: float) -> Case:
    """A point comes to touch, then slides; both directions differ."""
    still, moved = (0.0, 0.0), (0.8 * motion, 0.6 * motion)
    return Case((Step((still,), (load,), dt), Step((moved,), (load,), dt)))


def path_case(motions: Sequence[float] = (1e-6, 1e-3, -0.1, 10.0), load: float = 1.0) -> Case:
    """A point slides to and fro under loads that change."""
    steps = [Step(((0.0, 0.0),), (load,))]
    for number, motion in enumerate(motions, 1):
        steps.append(Step(((0.8 * motion, 0.6 * motion),), (load * number,)))
    return Case(tuple(steps))


def answers(subject: Subject, case: Case, **options: object) -> list[Answer]:
    """`respond`, where a scene that is refused is an answer as well."""
    try:
        return respond(subject, case, **options)
    except Error as error:
        return [Answer(failure=error)]


class Endless(Exception):  # noqa: N818 - an answer, not an error
    """The routine did not return; the message says within which time."""


def watched(
    subject: Subject, case: Case, *, seconds: float = 1.0, trace: bool = True
) -> tuple[Error | None, frozenset[str]]:
    """Runs a case in a checked driver: the failure that ends it, and which arguments are read.

    Raises:
        Endless: a call did not return within `seconds` of processor time.
    """
    read: frozenset[str] = frozenset()
    try:
        run = run_of(subject, case, checked=1)
        run.driver.time_limit = seconds
        run.driver.tracing = trace
        for index in range(len(case.steps)):
            run.step(index)
            read |= run.driver.observed().read
    except Error as error:
        if "did not return within" in str(error):
            raise Endless(f"the routine did not return within {seconds:g} s") from error
        return error, read
    return None, read


def share(answer: Answer, step: Step) -> float:
    """Friction along the motion over the load, or the coefficient; NaN where there is none."""
    if answer.failure is not None:
        return math.nan
    if answer.coefficient is not None:
        return float(answer.coefficient[0])
    if answer.friction is None or step.load[0] == 0:
        return math.nan
    motion = np.array(step.motion[0], dtype=float)
    size = float(np.linalg.norm(motion))
    return float(answer.friction[:, 0] @ motion) / (size * step.load[0]) if size else math.nan


def cost(subject: Subject) -> float:
    """How far the friction is from ordinary; 0 where it is ordinary."""
    found, bad = [], 0.0
    try:
        watched(subject, probe_case(subject, *_PROBES[1]), seconds=0.25, trace=False)
    except Endless:
        return math.inf
    for motion, load, dt in _PROBES:
        case = probe_case(subject, motion, load, dt)
        given = answers(subject, case)
        value = share(given[-1], case.steps[-1]) if len(given) == 2 else math.nan
        if math.isfinite(value):
            found.append(value)
        else:
            bad += 10.0
    if found and max(found) <= 0.0 > min(found):
        # Always against the expected direction: a sign is wrong, not a value.
        found, bad = [-v for v in found], bad + AGAINST
    bad += 3.0 * sum(v < 0 for v in found)
    sliding = [v for v in found if v > 0]
    if not sliding:
        return bad + 30.0
    nearest = min(max(math.log10(_LOW / v), math.log10(v / _HIGH), 0.0) for v in sliding)
    return round(bad + nearest, 3)


def matters(subject: Subject, index: int) -> bool:
    """Whether another value of one property changes anything that the routine answers."""
    places = (subject.around, *subject.others)
    return any(_matters_at(subject.but(around=a), index) for a in places)


def _matters_at(subject: Subject, index: int) -> bool:
    case = path_case()
    present = answers(subject, case)
    for factor in (1.25, 0.5):
        values = list(subject.props)
        values[index] = values[index] * factor if values[index] else factor
        other = answers(subject.but(props=tuple(values)), case)
        if len(other) != len(present) or any(
            different(a, b) for a, b in zip(present, other, strict=True)
        ):
            return True
    return False


def choose(
    subject: Subject, *, grow: Callable[[Subject], Subject] | None = None, most: int = 400
) -> tuple[Subject, str]:
    """The subject with the best values found, and why these, in words.

    Args:
        grow: gives a subject more properties if its routine asks for them, as a routine with a
            table does where a property counts the others.
        most: how many times the routine may be tried.
    """
    left = _Budget(most)
    best, lowest = subject, cost(subject)
    for pattern in _patterns():
        if lowest == 0.0 or not left.take():
            break
        tried = _filled(subject, pattern, grow)
        if (now := cost(tried)) < lowest:
            best, lowest = tried, now
    if lowest > 0.0:
        best, lowest = _one_by_one(best, lowest, left, grow)
    if lowest not in (0.0, AGAINST):
        return best, "no values were found at which friction is ordinary"
    best, idle = _all_matter(best, left)
    words = f"{CHOSEN} so that friction lies along the motion and is of the size of the load"
    if lowest == AGAINST:
        words = (
            f"{CHOSEN} so that friction is of the size of the load; it has the wrong sign at all "
            "values that were tried"
        )
    if idle:
        listed = ", ".join(f"props({k + 1})" for k in idle)
        words += f"; {listed} changed nothing at any value that was tried"
    return best, words


class _Budget:
    def __init__(self, most: int) -> None:
        self.left = most

    def take(self) -> bool:
        self.left -= 1
        return self.left >= 0


#: Makes a list of so many values.
Pattern = Callable[[int], tuple[float, ...]]


def _patterns() -> Iterator[Pattern]:
    """Whole lists of values."""
    yield lambda count: (0.3,) * count
    # Tables: rising, and rising behind the number of their points.
    yield lambda count: tuple(round(0.1 * (k + 1), 9) for k in range(count))
    yield lambda count: tuple(round(0.1 * k, 9) if k else 2.0 for k in range(count))
    for rest in (1.0, 1e-3, 100.0, 1e4):
        for place in range(6):
            yield lambda count, rest=rest, place=place: tuple(  # type: ignore[misc]
                0.3 if k == min(place, count - 1) else rest for k in range(count)
            )


def _filled(
    subject: Subject, pattern: Pattern, grow: Callable[[Subject], Subject] | None
) -> Subject:
    """The subject with values of a pattern, as many as the routine wants with these."""
    for _ in range(8):
        tried = subject.but(props=pattern(len(subject.props)))
        grown = grow(tried) if grow else tried
        if len(grown.props) == len(tried.props):
            return grown
        subject = grown
    return tried


def alternatives(props: tuple[float, ...]) -> Iterator[tuple[float, ...]]:
    """Other values: whole lists, then one property after the other."""
    for pattern in _patterns():
        yield pattern(len(props))
    for index in range(min(len(props), 12)):
        for value in TRIED:
            yield (*props[:index], value, *props[index + 1 :])


def _one_by_one(
    best: Subject, lowest: float, left: _Budget, grow: Callable[[Subject], Subject] | None
) -> tuple[Subject, float]:
    for index in range(min(len(best.props), 12)):
        for value in TRIED:
            if lowest == 0.0 or not left.take():
                return best, lowest
            tried = _with(best, index, value)
            if grow:
                tried = grow(tried)
            if (now := cost(tried)) < lowest:
                best, lowest = tried, now
    return best, lowest


def _all_matter(best: Subject, left: _Budget) -> tuple[Subject, list[int]]:
    """Other values for properties that change nothing, if friction stays ordinary with them: of
    these properties, then of those that may hide them, as a limit does."""
    ordinary = cost(best)
    for index in range(len(best.props)):
        if matters(best, index):
            continue
        for value in TRIED:
            if not left.take():
                break
            tried = _with(best, index, value)
            if matters(tried, index) and cost(tried) == ordinary and _others(best, tried, index):
                best = tried
                break
    idle = _idle(best)
    for index in [k for k in range(len(best.props)) if k not in idle]:
        for value in TRIED:
            if not idle or not left.take():
                return best, idle
            tried = _with(best, index, value)
            if cost(tried) == ordinary and len(fewer := _idle(tried)) < len(idle):
                best, idle = tried, fewer
    return best, idle


def _idle(subject: Subject) -> list[int]:
    """Properties that change nothing."""
    return [k for k in range(len(subject.props)) if not matters(subject, k)]


def _others(before: Subject, after: Subject, index: int) -> bool:
    """Whether the properties that mattered still do."""
    rest = [k for k in range(len(before.props)) if k != index]
    return all(matters(after, k) for k in rest if matters(before, k))


def _with(subject: Subject, index: int, value: float) -> Subject:
    values = list(subject.props)
    values[index] = value
    return subject.but(props=tuple(values))
