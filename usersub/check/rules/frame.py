# SPDX-License-Identifier: MIT
"""Friction belongs to the motion and not to the axes: turned, reversed and bent paths."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.response_of import (
    ask,
    friction,
    motions,
    moved,
    preferred_directions,
    reversed_,
    slide,
    straight,
    tolerance,
    turned,
)
from usersub.check.respond.answer import Answer
from usersub.check.rule import COEFFICIENT, FRICTION, Finding, NotApplicable, rule
from usersub.check.rules.figures import values
from usersub.check.subject import Subject

#: Angles by which cases are turned: no multiple of a right angle.
_ANGLES = (math.radians(30.0), math.radians(205.0))
#: What is compared in turned directions, and what changes its sign with the motion.
_VECTORS = ("friction", "dslip")
_SCALARS = ("sed", "sfd", "coefficient", "second")
_WORDS = {"friction": "friction", "dslip": "DSLIP", "sed": "SED", "sfd": "SFD"}
#: Increments after a turn, the least of them, and factors by which time and motion grow until the
#: old direction is gone.
_AFTER, _LEAST = 14, 6
_GROWTH = (1.0, 10.0, 100.0)


def _two(subject: Subject) -> Iterator[Case]:
    yield straight(subject, 0.0)
    yield cases.history(subject, [m for m in cases.PATH if any(m)])
    yield cases.sticking(subject, 1, 2)


def _with_rates(subject: Subject) -> bool:
    """Whether the routine knows the direction of the motion at all."""
    face = subject.interface
    return face.name not in COEFFICIENT or (face.name, face.generation) == ("fric_coef", "2022")


@rule(
    "frame.rotation",
    "A path in another direction gives the same friction, turned with it.",
    reference="isotropic friction: slip direction and stress direction coincide whatever the axes; "
    "component-wise regularisation breaks it",
    interfaces=("fric", "fric_coef", "vfric", "vfriction"),
    cases=_two,
)
def rotation(subject: Subject, case: Case) -> Finding | None:
    """Turns the whole path by angles that are no multiple of a right angle."""
    if not _with_rates(subject):
        raise NotApplicable("the routine knows the size of the slip rate, but no direction")
    if case.directions < 2:
        raise NotApplicable("there is one friction direction")
    ones = _answers(subject, case)
    for angle in _ANGLES:
        others = _answers(subject, turned(subject, case, angle))
        found = _unlike(subject, case, ones, others, 1.0)
        if found is None:
            continue
        step, name, one, other = found
        if _at_a_jump(subject, case, ones):
            continue
        standard = subject.interface.name == "fric"
        why = preferred_directions(subject) if standard else _by_direction(subject)
        if why or subject.anisotropic:
            raise NotApplicable(why or "the routine gives two coefficients")
        if subject.interface.name in COEFFICIENT and _prefers(subject, case):
            raise NotApplicable("the coefficient differs between directions a quarter turn apart")
        return Finding(
            f"{_WORDS.get(name, name)} in increment {step + 1} is {other} along the path when the "
            f"path is turned by {math.degrees(angle):.0f} degrees; expected {one} as before the "
            "turn",
            hint="make friction from the size of the sliding motion and its direction, not from "
            "one component after the other",
            figures={"step": step, "point": 0, "angle": angle},
        )
    return None


#: Angles and sizes of the motion at which friction is compared, and the least share that an
#: anisotropic law leaves in its weakest direction.
_WAYS, _SIZES, _LEAST_SHARE = (0.0, 0.6, 1.3, 2.2, 2.9), (0.1, 1.0, 10.0), 0.1


def _by_direction(subject: Subject) -> str:
    """Words on a law of the explicit interfaces whose friction differs between directions in the
    model by factors that do not depend on the size of the motion, and acts along the slip: an
    anisotropic law, and no component taken for the whole; "" for others."""
    if subject.interface.name not in FRICTION:
        return ""
    shares = []
    for size in _SIZES:
        found = []
        for angle in (*_WAYS, *(a + math.pi for a in _WAYS)):
            along = np.array([math.cos(angle), math.sin(angle)])
            force = slide(subject, straight(subject, angle, (size,)), need=False)[-1].friction
            if force is None or abs(along[0] * force[1, 0] - along[1] * force[0, 0]) > 1e-9 * abs(
                along @ force[:, 0]
            ):
                return ""
            found.append(float(along @ force[:, 0]))
        if min(found) <= 0.0:
            return ""
        shares.append(np.array(found) / max(found))
    half = len(_WAYS)
    same = all(np.allclose(s, shares[0], rtol=1e-6) for s in shares)
    both = np.allclose(shares[0][:half], shares[0][half:], rtol=1e-6)
    least = float(shares[0].min())
    if not (same and both and _LEAST_SHARE < least):
        return ""
    return (
        f"friction is along the slip and down to {least:.3g} of its largest value, by the "
        "direction in the model alone: the law is anisotropic"
    )


def _at_a_jump(subject: Subject, case: Case, ones: list[Answer]) -> bool:
    """Whether motions that differ by rounding alone give other answers, so that a turn may too."""
    size = 1e-12 * subject.scales.slip
    for x, y in ((size, 0.3 * size), (-size, 0.2 * size)):
        near = moved(case, lambda m, x=x, y=y: (m[0] + x, m[1] + y) if any(m) else m)
        if _unlike(subject, case, ones, _answers(subject, near), 1.0) is not None:
            return True
    return False


def _prefers(subject: Subject, case: Case) -> bool:
    quarter = turned(subject, case, 0.5 * math.pi)
    return _unlike(subject, case, ask(subject, case), ask(subject, quarter), 1.0) is not None


def _mirrored(subject: Subject) -> Iterator[Case]:
    for directions in cases.dimensions(subject)[::-1]:
        yield straight(subject, 0.0, directions=directions)
        yield cases.slipping(subject, 1, directions)
        yield cases.sticking(subject, 1, directions)
        if subject.interface.name in FRICTION:
            yield _bent(subject, 180.0, directions)


@rule(
    "frame.reversal",
    "Reversed motion gives the reversed friction.",
    reference="friction opposes the motion, whichever sign this has; stale slip flags break it",
    interfaces=("fric", "fric_coef", "vfric", "vfriction"),
    cases=_mirrored,
)
def reversal(subject: Subject, case: Case) -> Finding | None:
    """All motions the other way; then a slide that turns back."""
    if not _with_rates(subject):
        raise NotApplicable("the routine knows the size of the slip rate, but no direction")
    ones = _answers(subject, case)
    others = _answers(subject, reversed_(case))
    found = _unlike(subject, case, ones, others, -1.0)
    if found is not None:
        step, name, one, other = found
        return Finding(
            f"{_WORDS.get(name, name)} in increment {step + 1} is {other} when all motions are "
            f"reversed; expected {one}",
            hint="take the size of the slip (ABS, not the signed component) wherever a size is "
            "meant, and the direction from the motion",
            figures={"step": step, "point": 0},
        )
    try:
        return _stale(subject, case) if subject.interface.name in FRICTION else None
    except NotApplicable:  # the mirrored path has been compared all the same
        return None


def _turning(subject: Subject) -> Iterator[Case]:
    yield _bent(subject, 90.0, 2)


@rule(
    "frame.turn",
    "After a turn of the motion, friction follows the new direction.",
    reference="a direction or a flag that is kept from earlier increments goes stale",
    interfaces=FRICTION,
    cases=_turning,
)
def turn(subject: Subject, case: Case) -> Finding | None:
    """A slide, then a slide across it."""
    return _stale(subject, case)


def _bent(subject: Subject, degrees: float, directions: int) -> Case:
    """A slide, and as many increments in another direction."""
    way = cases.direction(math.radians(degrees))
    path = [(1.0, 0.0)] * _AFTER + [way] * _AFTER
    if directions == 1:
        path = [(round(x), 0.0) for x, _ in path]
    return cases.history(subject, path, directions=directions)


def _stale(subject: Subject, case: Case) -> Finding | None:
    """Compares the end of a bent path with a path that went its last way from the beginning.

    The motions grow until the old direction is forgotten: a law may need its time.
    """
    way = motions(case)[-1]
    before = motions(case)[1]
    if _parallel(way, before) or _count(case) < _LEAST:
        return None
    told = None
    for growth in _GROWTH:
        bent = _longer(case, growth)
        always = _always(bent)
        virgin = friction(slide(subject, always))[..., 0]
        if not _saturated(virgin):
            told = told or "friction grows as long as the motion: it forgets nothing"
            continue
        expected, found = virgin[-1], friction(slide(subject, bent, need=False))[-1, :, 0]
        largest = float(np.linalg.norm(expected))
        # a hundredth: the old direction fades, but is never quite gone
        unit = expected / largest if largest > 0 else expected
        off = np.linalg.norm(found - unit * max(float(found @ unit), 0.0))
        if off <= 1e-2 * max(largest, 1e-30) or largest == 0:
            return None
        last = (expected, found)
        told = None
    if told:
        raise NotApplicable(told)
    expected, found = last
    return Finding(
        f"friction is {values(found)} after {_count(case)} increments that follow a turn of the "
        f"motion; expected it along {values(expected)}, as without the turn",
        hint="take the direction from the motion of this increment (and the elastic slip), not "
        "from a state variable or flag that an earlier increment set",
        figures={"step": len(case.steps) - 1, "point": 0},
    )


def _always(case: Case) -> Case:
    """The case with the last motion in place of every other."""
    last = case.steps[-1].motion[0]
    return moved(case, lambda m: last if any(m) else m)


def _longer(case: Case, by: float) -> Case:
    """The same rates for a longer time."""
    steps = tuple(
        replace(s, motion=tuple(tuple(by * c for c in m) for m in s.motion), dt=by * s.dt)
        for s in case.steps
    )
    return case.but(steps=steps)


def _count(case: Case) -> int:
    """Increments at the end of the case that go the same way."""
    way = motions(case)
    count = 0
    for motion in way[::-1]:
        if not _parallel(motion, way[-1]):
            break
        count += 1
    return count


def _parallel(one: np.ndarray, other: np.ndarray) -> bool:
    a, b = one[:, 0], other[:, 0]
    return bool(a @ b >= (1.0 - 1e-9) * np.linalg.norm(a) * np.linalg.norm(b) and np.any(b))


def _saturated(path: np.ndarray) -> bool:
    """Whether friction at the end of a straight path is not more than in the middle."""
    end, middle = (float(np.linalg.norm(path[i])) for i in (-1, len(path) // 2))
    return end <= 1.02 * middle


def _answers(subject: Subject, case: Case) -> list[Answer]:
    return (
        ask(subject, case)
        if subject.interface.name in COEFFICIENT
        else slide(subject, case, need=False)
    )


def _unlike(
    subject: Subject, case: Case, ones: list[Answer], others: list[Answer], sign: float
) -> tuple[int, str, str, str] | None:
    """Step, name, expected and found value of the first difference that is more than rounding."""
    resting = subject.interface.solver == "explicit"  # then the first direction is arbitrary
    for name in (*_VECTORS, *_SCALARS):
        factor = sign if name in _VECTORS else 1.0
        pairs = [(getattr(a, name), getattr(b, name)) for a, b in zip(ones, others, strict=True)]
        if pairs[0][0] is None or pairs[0][1] is None:
            continue
        size = max(float(np.max(np.abs(a))) for a, _ in pairs)
        motion = float(np.max(np.abs([s.motion for s in case.steps])))
        if name == "dslip":  # a difference of motions: their rounding, not its own
            size = max(size, motion)
        elif name in ("sed", "sfd"):  # work: likewise that of friction along the motion
            forces = (float(np.max(np.abs(a.friction))) for a in ones if a.friction is not None)
            size = max(size, motion * max(forces, default=0.0))
        allowed = tolerance(subject) * size
        for step, (a, b) in enumerate(pairs):
            if resting and not any(any(m) for m in case.steps[step].motion):
                continue
            if np.max(np.abs(b - factor * a)) > allowed:
                return step, name, values((factor * a)[..., 0]), values(b[..., 0])
    return None
