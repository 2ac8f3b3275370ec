# SPDX-License-Identifier: MIT
"""The cone: no path gives more friction than a straight slide at the same pressure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.probing.response_of import alike, friction, slide, tolerance
from usersub.check.respond import run_of
from usersub.check.rule import FRICTION, Finding, rule
from usersub.check.rules.figures import number, values
from usersub.check.subject import Subject
from usersub.errors import Error

#: What a path may give more than the straight slides that it is compared with.
_MARGIN = 1.05
#: Factors on the rates of the straight slides: elastic motion makes the slip of a path smaller.
_RATES = (1.0, 2.0, 0.5, 0.1, 1e-2, 1e-4)
_DEGREES = (0.0, 45.0, 90.0, 135.0)
#: Motion of a rest over that of the increment before.
_STILL = 1e-9
#: Motion and time, over those of an increment, after which all that fades has gone.
_FAR = 1e6
#: A path that turns, stops and comes back.
WINDING = (
    (1.0, 0.0),
    (0.6, 0.5),
    (-0.8, 0.6),
    (0.0, 0.0),
    (-1.0, -0.9),
    (0.1, 0.0),
    (1.0, -0.3),
    (0.7, 0.7),
)
#: Loads of a slide that is unloaded and loaded again, over the load scale.
_LOADS = (1.0, 1.0, 1.5, 0.5, 0.25, 2.0, 2.0, 0.1, 0.3)


def _paths(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        yield cases.history(subject, WINDING, directions=directions)
        yield cases.sticking(subject, 1, directions)
        yield _under_changing_load(subject, directions)
        small = [(0.05 * x, 0.05 * y) for x, y in WINDING]
        yield cases.history(subject, [*WINDING, *small * 2], directions=directions)


def _under_changing_load(subject: Subject, directions: int) -> Case:
    path = [(1.0, 0.0)] * 3 + [(0.0, 0.0), (0.02, 0.01)] * 3
    made = cases.history(subject, path, directions=directions)
    loads = [1.0, *_LOADS]
    steps = tuple(
        replace(s, load=(subject.scales.load * p,)) for s, p in zip(made.steps, loads, strict=True)
    )
    return made.but(steps=steps)


@rule(
    "bound.cone",
    "No path gives more friction than a straight slide at the same pressure and rates.",
    reference="the stress lies within the critical stress, which is the coefficient times the "
    "pressure (and a limit or a cohesion)",
    interfaces=FRICTION,
    cases=_paths,
)
def cone(subject: Subject, case: Case) -> Finding | None:
    """Straight slides in several directions, at several rates, with and without rests."""
    answers = slide(subject, case, need=False)
    whole = friction(answers)
    bounds: dict[float, float] = {}
    for step, answer in enumerate(answers):
        if answer.lm is not None and np.any(answer.lm == 1):
            continue
        for point in range(case.points):
            load = case.steps[step].load[point]
            size = float(np.linalg.norm(whole[step, :, point]))
            if load not in bounds:
                bounds[load] = _straight_bound(subject, case, load)
            bound = bounds[load]
            if size <= _MARGIN * bound + tolerance(subject) * abs(load):
                continue
            if _fades(subject, case, step, point, bound):
                continue
            # what depends on the position differs between points: each slide as the only one
            bound = max(bound, _straight_bound(subject, case, load, alone=True))
            if size <= _MARGIN * bound + tolerance(subject) * abs(load):
                continue
            symbol = "|tau|" if subject.interface.name == "fric" else "size of the friction force"
            return Finding(
                f"{symbol} is {number(size)} in increment {step + 1}, with components "
                f"{values(whole[step, :, point])}; expected at most {number(bound)}, the most that "
                f"a straight slide gives under the load {number(load)}",
                hint=_hint(subject, case, step),
                figures={"step": step, "point": point, "bound": bound},
            )
    return None


def _hint(subject: Subject, case: Case, step: int) -> str:
    """What to change; a hidden 0/0 is told first, since a comparison with NaN says no."""
    usual = (
        "bring the stress back to the critical stress at the pressure of this increment, by its "
        "size and not component by component"
    )
    try:
        run = run_of(subject, case, checked=1)
        for index in range(step + 1):
            run.step(index)
        flags = run.driver.observed().flags
    except Error:
        return usual
    if not any("invalid" in flag for flag in flags):
        return usual
    return (
        "something like 0/0 happens in this increment (floating-point exception: invalid), and a "
        "comparison with NaN says no: look before every division and root"
    )


def _fades(subject: Subject, case: Case, step: int, point: int, bound: float) -> bool:
    """Whether friction that is too much after the load fell comes down with motion and time.

    Bristles keep their bend until motion or time bends them anew. Where next to no motion is
    enough, it is a rest that was forgotten.
    """
    loads = [s.load[point] for s in case.steps[: step + 1]]
    if max(loads) <= loads[-1]:
        return False
    far = tuple(_FAR * subject.scales.slip * c for c in cases.direction(0.0)[: case.directions])
    tiny = tuple(_STILL * c / _FAR for c in far)
    sizes = []
    for motion, longer in ((tiny, 1.0), (far, _FAR)):
        s = case.steps[step]
        last = replace(s, motion=(motion,) * case.points, dt=longer * s.dt)
        changed = case.but(steps=(*case.steps[:step], last))
        found = friction(slide(subject, changed, need=False))[-1, :, point]
        sizes.append(float(np.linalg.norm(found)) <= _MARGIN * bound)
    rests = not any(case.steps[step].motion[point])
    return sizes[1] and not (rests and sizes[0])


def _straight_bound(subject: Subject, case: Case, load: float, *, alone: bool = False) -> float:
    """The most friction that straight slides of the same sizes give under one load.

    Every slide is a contact point of its own in one case with the same surroundings, or a case of
    its own (`alone`), which takes longer.
    """
    degrees = _DEGREES if case.directions == 2 else _DEGREES[:1]
    slides = [
        (rate, cases.direction(math.radians(angle))[: case.directions])
        for angle in degrees
        for rate in _RATES
    ]
    groups = [[one] for one in slides] if alone else [slides]
    found = 0.0
    for rests in (False, True):
        for group in groups:
            straightened = alike(_straightened(case, group, load, rests), subject)
            answers = slide(subject, straightened, need=False)
            found = max(found, float(np.max(np.linalg.norm(friction(answers), axis=1))))
    return found


def _straightened(
    case: Case, slides: list[tuple[float, tuple[float, ...]]], load: float, rests: bool
) -> Case:
    """Motions of the size of those of the first point, each slide in its direction and rate."""
    made: list[Step] = []
    for step in case.steps:
        size = math.hypot(*step.motion[0])
        motion = tuple(tuple(rate * size * c for c in way) for rate, way in slides)
        force = load if made else abs(load) or 1.0  # it touches
        made.append(Step(motion, (force,) * len(slides), step.dt))
        if rests and made[1:]:
            # next to no motion: without any, the directions of explicit hosts are arbitrary
            still = tuple(tuple(_STILL * c for c in m) for m in made[-1].motion)
            made.append(replace(made[-1], motion=still))
    return Case(tuple(made), case.contact, props=case.props)
