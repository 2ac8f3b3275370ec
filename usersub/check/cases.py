# SPDX-License-Identifier: MIT
"""The cases that rules share: one set that reaches every branch of an ordinary friction law.

Motions come in units of the subject's slip and stick scales, loads in units of its load scale.
Every point has values of its own. A history begins with an increment in which the points come to
touch, since routines behind FRIC give no friction there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from usersub.check.case import Case, Step

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: Points of the cases with many points: more than a vector register, not a power of two.
MANY = 7

#: Loads in units of the load scale, besides those near it.
LOADS = (1e-3, 1e2, 1e4, 1e6)

#: Motions of a history in units of the slip scale, two directions.
PATH = ((1.0, 0.0), (1.3, 0.4), (-0.9, -0.2), (0.0, 0.0), (0.0, 1.1), (-0.6, 0.7))


def dimensions(subject: Subject) -> tuple[int, ...]:
    """Friction directions that the interface has: two, and one where there is 2-D contact."""
    return (2,) if subject.interface.name == "vfriction" else (2, 1)


def contacts(subject: Subject) -> tuple[str, ...]:
    """Kinds of contact that the interface knows."""
    return {
        "vfric": ("node-to-facet", "analytical-rigid"),
        "vfriction": ("node-to-facet", "edge-to-edge", "analytical-rigid"),
    }.get(subject.interface.name, ("node-to-facet",))


def step(
    subject: Subject,
    motions: Sequence[Sequence[float]],
    loads: Sequence[float],
    *,
    unit: float | None = None,
    directions: int = 2,
    **more: object,
) -> Step:
    """A step of motions in units of the slip scale and loads in units of the load scale."""
    size = subject.scales.slip if unit is None else unit
    motion = tuple(tuple(size * float(c) for c in m[:directions]) for m in motions)
    load = tuple(subject.scales.load * float(p) for p in loads)
    return Step(motion, load, **{"dt": subject.scales.dt, **more})  # type: ignore[arg-type]


def touch(subject: Subject, points: int = 1, directions: int = 2) -> Step:
    """The increment in which the points come to touch: no motion."""
    still = [(0.0,) * directions] * points
    return step(subject, still, [1.0 + 0.1 * k for k in range(points)], directions=directions)


def history(
    subject: Subject,
    path: Sequence[Sequence[float]],
    *,
    points: int = 1,
    directions: int = 2,
    unit: float | None = None,
    load: float = 1.0,
    **more: object,
) -> Case:
    """A case in which point k makes the motions of `path` times 1 + k/8 under its own load."""
    loads = [load * (1.0 + 0.1 * k) for k in range(points)]
    steps = [touch(subject, points, directions)]
    for motion in path:
        moved = [tuple(c * (1.0 + 0.125 * k) for c in motion) for k in range(points)]
        steps.append(step(subject, moved, loads, unit=unit, directions=directions, **more))
    return Case(tuple(steps))


def loaded(
    subject: Subject, path: Sequence[Sequence[float]], directions: int = 2
) -> Iterator[Case]:
    """The path under loads far from the load scale, where limits and other branches may lie.

    What sticks grows with the load, so motions do too (standard).
    """
    for load in LOADS:
        grows = subject.interface.solver == "standard" and load > 1.0
        unit = subject.scales.slip * (load if grows else 1.0)
        yield history(subject, path, directions=directions, unit=unit, load=load)


def slipping(subject: Subject, points: int = 1, directions: int = 2) -> Case:
    """Slip along a path with a reversal, a stop and a turn."""
    return history(subject, PATH, points=points, directions=directions)


def sticking(subject: Subject, points: int = 1, directions: int = 2) -> Case:
    """Motion within elastic stick (or a thousandth of the slip scale where there is none)."""
    unit = subject.scales.stick or 1e-3 * subject.scales.slip
    path = ((0.2, 0.1), (0.1, -0.3), (-0.4, 0.1))
    return history(subject, path, points=points, directions=directions, unit=unit)


def changing_load(subject: Subject, points: int = 1, directions: int = 2) -> Case:
    """Slip while the load falls to zero and comes back."""
    motions = ((1.0, 0.3), (0.8, -0.2), (0.7, 0.5), (1.0, 0.1))
    steps = [touch(subject, points, directions)]
    for factor, motion in zip((1.0, 0.5, 0.0, 2.0), motions, strict=True):
        moved = [tuple(c * (1.0 + 0.125 * k) for c in motion) for k in range(points)]
        loads = [factor * (1.0 + 0.1 * k) for k in range(points)]
        steps.append(step(subject, moved, loads, directions=directions))
    return Case(tuple(steps))


def plain(subject: Subject, directions: int) -> Iterator[Case]:
    """A slide, elastic motion, and a slide under a load that changes."""
    yield slipping(subject, 1, directions)
    yield sticking(subject, 1, directions)
    yield changing_load(subject, 2, directions)


def held(subject: Subject, points: int = 1, directions: int = 2) -> Case:
    """Slip that the stick force limits (explicit)."""
    made = slipping(subject, points, directions)
    limited = [
        Step(s.motion, s.load, s.dt, stick=tuple(0.05 * p for p in s.load)) for s in made.steps
    ]
    return made.but(steps=tuple(limited))


def pulled(subject: Subject, directions: int = 2) -> Case:
    """Slip at a pressure below zero, as an iteration of an implicit host may meet it."""
    made = slipping(subject, 1, directions)
    steps = (*made.steps[:2], *(replace(s, load=(-s.load[0],)) for s in made.steps[2:]))
    return made.but(steps=steps)


def everything(subject: Subject) -> Iterator[Case]:
    """The common cases, and what an implicit host may ask for besides."""
    yield from common(subject)
    if subject.interface.solver == "standard":
        for directions in dimensions(subject):
            yield pulled(subject, directions)


def common(subject: Subject) -> Iterator[Case]:
    """Every branch of an ordinary law, smallest cases first, in all dimensions and contacts."""
    for directions in dimensions(subject):
        for points in (1, MANY):
            yield slipping(subject, points, directions)
            yield sticking(subject, points, directions)
            yield changing_load(subject, points, directions)
            if subject.interface.solver == "explicit":
                yield held(subject, points, directions)
    for contact in contacts(subject)[1:]:
        for points in (1, MANY):
            yield slipping(subject, points).but(contact=contact)
            yield changing_load(subject, points).but(contact=contact)


def direction(angle: float) -> tuple[float, float]:
    """Unit vector at an angle (radian) to the first direction."""
    return math.cos(angle), math.sin(angle)
