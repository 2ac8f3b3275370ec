# SPDX-License-Identifier: MIT
"""Sizes at which a routine shows what it does, found by running it over the decades.

Looked for are a motion that certainly slips, the largest motion that still sticks elastically, a
load at which friction is not at a limit, a time increment and a temperature at which the law
changes. Where nothing tells, the ordinary sizes of `Scales` stay.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.case import Case, Step
from usersub.check.respond.explicit import AMPLE
from usersub.check.rule import COEFFICIENT
from usersub.check.subjects.apart import apart
from usersub.check.subjects.values import Endless, answers, path_case, watched

if TYPE_CHECKING:
    from usersub.check.respond import Answer
    from usersub.check.subject import Subject

#: Decades that are looked at.
_MOTIONS = tuple(10.0**k for k in range(-12, 7))
_LOADS = tuple(10.0**k for k in range(-6, 10))
_TIMES = tuple(10.0**k for k in range(-4, 5))
#: Not round, so that what lies between two of them is no corner of somebody's table.
_TEMPERATURES = (-110.0, -10.0, 20.0, 55.0, 110.0, 230.0, 470.0, 950.0, 1900.0)

#: Slopes in a double logarithmic plot above which friction follows, and below which it does not.
_FOLLOWS, _RESTS = 0.9, 0.5
#: A relative difference that is a change.
_CHANGE = 0.1
#: Time limit of the search, seconds.
_SECONDS = 5.0
#: Largest and smallest slip of an increment: others do not fit a model or lose digits.
_SLIPS = (1e-9, 1e3)
#: Shares of the motion at which friction rises no more; the first that sticks elastically is taken.
_STICKS = (0.5, 0.25, 0.1)


def find(subject: Subject) -> Subject:
    """The subject with the scales at which its routine shows what it does."""
    if subject.routine is None:
        return subject
    found, why = apart(_found, subject, _SECONDS)
    if why:
        origin = {**subject.origin, "scales": f"as they are by default: {why}"}
        return subject.but(origin=origin)
    return found


def _found(subject: Subject, tell: Callable[[Subject], None]) -> Subject:
    del tell
    try:
        watched(subject, path_case())
    except Endless as endless:
        origin = {**subject.origin, "scales": f"as they are by default: {endless}"}
        return subject.but(origin=origin)
    said: dict[str, str] = {}
    if subject.temperatures:
        subject = _temperature(subject, said)
    subject = _slip(subject, said)
    before, subject = subject, _load(subject, said)
    if subject != before:
        subject = _slip(subject, said)
    subject = _time(subject, said)
    words = "; ".join(said.values()) or "nothing tells: the ordinary ones"
    return subject.but(origin={**subject.origin, "scales": words})


# Looking.


def _answer(subject: Subject, motions: Sequence[float], load: float, dt: float) -> list[Answer]:
    """A point comes to touch and makes the motions, all along one direction."""
    directions = [(0.0, 0.0), *((0.8 * m, 0.6 * m) for m in motions)]
    case = Case(tuple(Step(((a, b),), (load,), dt) for a, b in directions))
    given = answers(subject, case)
    whole = len(given) == len(case.steps) and given[-1].failure is None
    return given[1:] if whole else []


def size(subject: Subject, motion: float, load: float, dt: float) -> float:
    """Friction along the first motion (the coefficient times the load), NaN if there is none."""
    found = _answer(subject, (motion,), load, dt)
    if not found:
        return math.nan
    along = abs(_along(subject, found[0], load))  # rules tell of a wrong sign
    # There the stick force limits it, not the routine.
    limited = subject.interface.name in ("vfric", "vfriction") and along > 0.5 * AMPLE * abs(load)
    return math.nan if limited else along


def _along(subject: Subject, answer: Answer, load: float) -> float:
    if subject.interface.name in COEFFICIENT:
        assert answer.coefficient is not None
        return float(answer.coefficient[0]) * load
    assert answer.friction is not None
    return float(answer.friction[:, 0] @ np.array([0.8, 0.6]))


def _slopes(places: Sequence[float], sizes: Sequence[float]) -> list[float]:
    """Slope of log size over log place in each interval; NaN where a size is not positive."""
    slopes = []
    for (a, b), (x, y) in zip(
        zip(places, places[1:], strict=False), zip(sizes, sizes[1:], strict=False), strict=True
    ):
        good = x > 0 and y > 0 and math.isfinite(x) and math.isfinite(y)
        slopes.append(math.log(y / x) / math.log(b / a) if good else math.nan)
    return slopes


# Deciding.


def _slip(subject: Subject, said: dict[str, str]) -> Subject:
    """Motion that slips, and the largest that sticks."""
    scales = subject.scales
    sizes = [size(subject, m, scales.load, scales.dt) for m in _MOTIONS]
    slopes = _slopes(_MOTIONS, sizes)
    rises = [k for k, s in enumerate(slopes) if s > _FOLLOWS]
    rests = [k for k, s in enumerate(slopes) if s < _RESTS]
    if rises and rests and rises[0] < rests[-1]:
        return _after_stick(subject, sizes, slopes, said)
    if not any(x > 0 for x in sizes):
        said["slip"] = "no friction was seen at any motion from 1e-12 to 1e6"
        return subject
    at = _where(_MOTIONS, sizes)
    if at is None:
        return subject
    slip = min(max(at, _SLIPS[0]), _SLIPS[1])
    said["slip"] = f"friction changes around a motion of {slip:.3g} in {scales.dt:g}"
    return subject.but(scales=replace(scales, slip=slip))


def _after_stick(
    subject: Subject, sizes: list[float], slopes: list[float], said: dict[str, str]
) -> Subject:
    """The scales of a routine whose friction rises with the motion, then no more."""
    scales = subject.scales
    last = max(k for k, s in enumerate(slopes) if s > _FOLLOWS)
    knee = _knee(subject, _MOTIONS[last + 1], sizes[last] / _MOTIONS[last])
    slip = 10.0 * knee
    first = next((k for k, m in enumerate(_MOTIONS) if m >= slip), len(_MOTIONS))
    at = _where(_MOTIONS[first:], sizes[first:])
    if at is not None:
        slip = max(slip, at)
    slip = _round(slip)
    said["slip"] = f"friction rises with the motion up to {knee:.3g}; {slip:g} slips"
    stick = next((s for f in _STICKS if _elastic(subject, s := _round(f * knee))), 0.0)
    if stick:
        said["stick"] = f"up to {stick:g} it stays at rest and goes when the motion goes back"
    return subject.but(scales=replace(scales, slip=slip, stick=stick))


def _round(value: float) -> float:
    """Two digits: nobody wants to read more."""
    return float(f"{value:.1e}")


def _knee(subject: Subject, near: float, stiffness: float) -> float:
    """Where the straight line of small motions meets the friction of large ones."""
    scales = subject.scales
    large = size(subject, 10.0 * near, scales.load, scales.dt)
    if math.isfinite(large) and large > 0 and stiffness > 0:
        return large / stiffness
    return near


def _elastic(subject: Subject, motion: float) -> bool:
    """Whether friction stays while nothing moves, and goes when the motion goes back."""
    if subject.interface.name in COEFFICIENT or motion <= 0:
        return False
    scales = subject.scales
    found = _answer(subject, (motion, 0.0, -motion), scales.load, scales.dt)
    if not found:
        return False
    there, held, back = (_along(subject, a, scales.load) for a in found)
    tiny = 1e-3 * abs(there)
    return there > 0 and abs(held - there) <= tiny and abs(back) <= tiny


def _where(places: Sequence[float], sizes: Sequence[float]) -> float | None:
    """Where friction begins to change: middle of the first decade with half of the largest change.

    None if it does not change, or as much at once from the first decade on: then no place is
    different from any other.
    """
    changes = [
        abs(math.log(y / x)) if x > 0 and y > 0 and math.isfinite(x) and math.isfinite(y) else 0.0
        for x, y in zip(sizes, sizes[1:], strict=False)
    ]
    largest = max(changes, default=0.0)
    if largest < _CHANGE:
        return None
    first = next(k for k, c in enumerate(changes) if c >= 0.5 * largest)
    return _round(math.sqrt(places[first] * places[first + 1])) if first else None


def _load(subject: Subject, said: dict[str, str]) -> Subject:
    """Load at which friction is there and still follows the load."""
    scales = subject.scales
    sizes = [size(subject, scales.slip, p, scales.dt) for p in _LOADS]
    slopes = _slopes(_LOADS, sizes)
    at = _LOADS.index(1.0)
    below = [k for k in range(at) if slopes[k] > _FOLLOWS]
    above = [k for k in range(at, len(slopes)) if slopes[k] > _RESTS]
    present = [k for k, x in enumerate(sizes) if x > 0]
    if present and at not in present:
        load = _LOADS[min(present, key=lambda k: abs(k - at))]
        said["load"] = f"there is no friction at a load of 1, but at {load:g}"
    elif slopes[at] > _RESTS or slopes[at - 1] > _FOLLOWS:
        return subject
    elif below and not above:
        load = _LOADS[below[-1]]
        said["load"] = f"friction follows the load up to about {_LOADS[below[-1] + 1]:g}"
    elif above and not below and abs(slopes[at]) < 0.1:
        load = _LOADS[above[0]]
        said["load"] = f"friction follows the load from about {load:g} on"
    else:
        return subject
    return subject.but(scales=replace(scales, load=load))


def _time(subject: Subject, said: dict[str, str]) -> Subject:
    """Time increment at which the rate matters, if it does not at the present one."""
    scales = subject.scales
    present = [size(subject, scales.slip, scales.load, scales.dt * f) for f in (0.1, 1.0, 10.0)]
    if max(present) - min(present) > _CHANGE * max(present):
        return subject
    sizes = [size(subject, scales.slip, scales.load, t) for t in _TIMES]
    at = _where(_TIMES, sizes)
    if at is None:
        return subject
    said["dt"] = f"friction depends on the slip rate around {scales.slip:g} in {at:g}"
    return subject.but(scales=replace(scales, dt=at))


def _temperature(subject: Subject, said: dict[str, str]) -> Subject:
    """A temperature at which there is friction and at which it changes."""
    scales = subject.scales

    def at(temperature: float) -> float:
        moved = subject.but(scales=replace(scales, temperature=temperature))
        return max(size(moved, m, scales.load, scales.dt) for m in (1.0, 1e-3))

    sizes = [at(t) for t in _TEMPERATURES]
    here = _TEMPERATURES.index(20.0)
    if _changes(sizes[here - 1 : here + 2]):
        return subject
    for k in sorted(range(len(sizes) - 1), key=lambda k: abs(k - here)):
        if _changes(sizes[k : k + 2]):
            middle = 0.5 * (_TEMPERATURES[k] + _TEMPERATURES[k + 1])
            said["temperature"] = f"friction changes with the temperature around {middle:g}"
            return subject.but(scales=replace(scales, temperature=middle))
    return subject


def _changes(sizes: Sequence[float]) -> bool:
    """Whether there is friction, and not the same everywhere."""
    there = all(math.isfinite(x) and x > 0 for x in sizes)
    return there and max(sizes) - min(sizes) > 1e-6 * max(sizes)
