# SPDX-License-Identifier: MIT
"""Friction takes energy: work along paths, push and release, holds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.response_of import (
    elasticity,
    friction,
    motions,
    slide,
    straight,
    tolerance,
)
from usersub.check.respond import run_of
from usersub.check.rule import FRICTION, CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules import energy_density
from usersub.check.rules.figures import number, values
from usersub.check.subject import Subject
from usersub.driver.standard import StandardDriver
from usersub.errors import Error

__all__ = ["dissipation", "energy_density", "hold", "push_release"]

#: Increments of a push, and of the release.
_PUSH = 30
#: Pairs of numbers of increments in which the same time is held.
_HOLDS = ((1, 100), (20, 2000))
#: Relative change of stress that rounding over the longest hold does not make.
_DRIFT = 1e-9


def _loops(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        there = [(0.5, 0.2)] * 4
        back = [(-0.5, -0.2)] * 4
        yield cases.history(subject, [*there, *back, *there, *back], directions=directions)
        yield cases.history(subject, [*cases.PATH, *cases.PATH[::-1]], directions=directions)
        unit = subject.scales.stick or 1e-3 * subject.scales.slip
        yield cases.history(subject, [*there, *back] * 2, directions=directions, unit=0.4 * unit)


@rule(
    "energy.dissipation",
    "From rest on, friction never gives back more work than it took.",
    reference="friction is no source of energy: the work of friction on a path from rest is not "
    "negative",
    interfaces=FRICTION,
    cases=_loops,
)
def dissipation(subject: Subject, case: Case) -> Finding | None:
    """Sums the work of closed loops."""
    answers = slide(subject, case, need=False)
    whole, way = friction(answers), motions(case)
    work, traffic = np.zeros(case.points), np.zeros(case.points)
    for step, answer in enumerate(answers):
        if answer.lm is not None and np.any(answer.lm == 1):
            continue
        # stress at the end of the increment: never less than the work of elastic motion
        work += np.sum(whole[step] * way[step], axis=0)
        traffic += np.linalg.norm(whole[step], axis=0) * np.linalg.norm(way[step], axis=0)
        point = int(np.argmin(work))
        if work[point] < -max(1e-6, tolerance(subject)) * traffic[point]:
            return Finding(
                f"the work of friction from rest is {number(float(work[point]))} after increment "
                f"{step + 1}; expected 0 or more",
                hint="let friction act against the slip, and let no elastic slip grow beyond its "
                "limit",
                figures={"step": step, "point": point},
            )
    return None


def _pushes(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        for size in (0.25, 4.0):
            sizes = [size] * _PUSH + [-size] * _PUSH
            yield straight(subject, 0.3, sizes, directions=directions)


@rule(
    "energy.push-release",
    "What is released after a push is at most the elastic energy stored on the way to slip.",
    reference="a body that has slid stays where it is; it does not creep back",
    interfaces=FRICTION,
    cases=_pushes,
)
def push_release(subject: Subject, case: Case) -> Finding | None:
    """Pushes far, and goes back as long as the stress still points the old way."""
    answers = slide(subject, case, need=False)
    whole, way = friction(answers)[..., 0], motions(case)[..., 0]
    turn = _turn(way)
    if turn is None:
        return None
    unit = way[turn - 1] / np.linalg.norm(way[turn - 1])
    stress, size = whole @ unit, way @ unit
    largest = float(np.max(stress[:turn]))
    if not largest > 0:
        return None
    slips_at = int(np.argmax(stress[:turn] >= 0.99 * largest))
    # upper bound of what went in until it slipped, lower bound of what comes out
    stored = 1.25 * float(np.sum(stress[: slips_at + 1] * size[: slips_at + 1]))
    released, last = 0.0, turn
    for step in range(turn, len(stress)):
        if not stress[step] > 0:
            break
        released -= stress[step] * size[step]
        last = step
    # what one increment may hide
    allowed = stored + largest * abs(float(size[turn]))
    if released <= allowed:
        return None
    return Finding(
        f"after a push of {number(float(np.sum(size[:turn])))} friction gives back the work "
        f"{number(released)} over {number(-float(np.sum(size[turn : last + 1])))} of motion; "
        f"expected at most {number(allowed)}, what was stored before it slipped",
        hint="keep the elastic slip within its limit and make the rest of the motion slip; stress "
        "must not depend on the whole motion since the touch",
        figures={"step": last, "point": 0},
    )


def _turn(way: np.ndarray) -> int | None:
    """The first increment that goes against the first motion."""
    first = next((m for m in way if np.any(m)), None)
    if first is None:
        return None
    for index, motion in enumerate(way):
        if motion @ first < 0:
            return index
    return None


def _held(subject: Subject) -> Iterator[Case]:
    unit = subject.scales.stick or 1e-3 * subject.scales.slip
    back = -0.3 * unit / subject.scales.slip
    for directions in cases.dimensions(subject)[::-1]:
        yield straight(subject, 0.4, (1.0, 1.0, back, 0.0), directions=directions)
        yield cases.history(subject, [(0.4, 0.2), (0.0, 0.0)], directions=directions, unit=unit)


@rule(
    "energy.hold",
    "A point that is held keeps its stress, however many increments the time is cut into.",
    reference="a static load does not creep, unless the law relaxes with time",
    interfaces=FRICTION,
    cases=_held,
)
def hold(subject: Subject, case: Case) -> Finding | None:
    """Holds for the same time in few and in many increments."""
    if any(any(m) for m in case.steps[-1].motion):
        return None
    if subject.interface.solver == "explicit" and not elasticity(subject).elastic:
        raise NotApplicable(
            "friction has no memory of the motion: without motion the stick force alone counts"
        )
    answers = slide(subject, case, need=False)
    if answers[-1].lm is not None and np.any(answers[-1].lm):
        return None
    start = friction(answers)[-1, :, 0]
    size = float(np.linalg.norm(start))
    before = float(np.max(np.abs(friction(answers))))
    if size <= 1e-6 * before or not size:
        return None  # it carries no stress at rest
    drift = _DRIFT if subject.precision == "double" else 1e-3
    for few, many in _HOLDS:
        one, other = (_after(subject, case, count, few) for count in (few, many))
        changes = [float(np.linalg.norm(v - start)) / size for v in (one, other)]
        if changes[1] > drift and changes[1] > 3.0 * changes[0]:
            return Finding(
                f"friction drifts from {values(start)} to {values(other)} while the point is held "
                f"for {many} increments, and to {values(one)} in {few} of the same time together; "
                "expected it to stay, or to depend on time alone",
                hint="change the state with the motion or with the time increment, not in every "
                "call",
                figures={"step": len(case.steps) - 1, "point": 0, "increments": many},
            )
    return None


def _after(subject: Subject, case: Case, count: int, whole: int) -> np.ndarray:
    """Friction after `whole` times the last increment again, in `count` increments."""
    last = replace(case.steps[-1], dt=case.steps[-1].dt * whole / count)
    run = run_of(subject, case)
    try:
        for index in range(len(case.steps)):
            run.step(index)
        run.case = case.but(steps=(*case.steps[:-1], last))
        if isinstance(run.driver, StandardDriver):
            _hold_quickly(run.driver, last.dt, count - 1)
        else:
            for _ in range(count - 1):
                run.driver.step(last.dt)  # type: ignore[attr-defined]
        answer = run.step(len(case.steps) - 1)
    except Error as error:
        raise CannotCheck(f"the routine failed while it was held: {error}") from error
    assert answer.friction is not None
    return np.array(answer.friction[:, 0])


def _hold_quickly(driver: StandardDriver, dt: float, count: int) -> None:
    """Commits `count` increments with what is bound."""
    if not count:
        return
    driver.begin_increment(dt)
    driver.iterate()
    iterate = driver.prepare()
    for left in range(count, 0, -1):
        iterate()
        driver.commit()
        if left > 1:
            driver.begin_increment(dt)
