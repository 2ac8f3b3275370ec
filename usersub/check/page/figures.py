# SPDX-License-Identifier: MIT
"""What the figures of a routine show, as plain numbers: computed here, drawn in `drawing`.

Every function runs the routine, which may crash: call them through `safely.tried`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.case import Case, Step
from usersub.check.page.names import friction_name, load_name, load_plural, ratio_name
from usersub.check.respond.explicit import AMPLE
from usersub.check.rule import COEFFICIENT

if TYPE_CHECKING:
    from usersub.check.respond import Answer
    from usersub.check.subject import Subject

#: Numbers of one figure: JSON can carry them.
Data = dict[str, Any]

_DECADES = 3  # of slip rate on both sides of the subject's
_RATES = 25
_PRESSURES = 13
_SLIDES = 4  # increments of the slip scale until friction is looked at
_ANGLES = 48  # directions of sliding
_WIDE = 100.0  # largest over smallest value that want logarithmic axes
_QUARTER = 12  # increments of a quarter of a cycle
_ROUNDING = {"double": 1e-9, "single": 1e-5}  # relative variation that counts as none
_DIRECTION = {"double": 1e-6, "single": 1e-4}  # sideways part of friction that counts as none


class Refused(Exception):  # noqa: N818 - a sentence in place of a figure
    """There is nothing to draw; the message says why."""


def surface(subject: Subject) -> Data:
    """Friction over load after sliding a fixed distance, over slip rate and load."""
    rates = _rate_scale(subject) * np.logspace(-_DECADES, _DECADES, _RATES)
    loads = subject.scales.load * np.logspace(-1.0, 1.0, _PRESSURES)
    values = []
    for rate in rates:
        case = _steady(subject, loads, rate)
        values.append(_signed(subject, _last(subject, case), loads))
    found = np.array(values).T
    if not np.isfinite(found).any():
        raise _no_slip(subject)
    if not _varies(subject, found):
        raise Refused(
            f"The {ratio_name(subject)} is {found[np.isfinite(found)][0]:.6g} at all slip rates "
            f"from {rates[0]:.3g} to {rates[-1]:.3g} and all {load_plural(subject)} from "
            f"{loads[0]:.3g} to {loads[-1]:.3g}."
        )
    return {
        "rates": rates.tolist(),
        "loads": loads.tolist(),
        "values": found.tolist(),
        "wide": _wide(found),
        "by_rate": any(_varies(subject, row) for row in found),
        "by_load": any(_varies(subject, column) for column in found.T),
        "distance": _SLIDES * subject.scales.slip,
        "ratio": ratio_name(subject),
        "load_name": load_name(subject),
    }


def loop(subject: Subject) -> Data:
    """Friction against motion along a triangular cycle, under two loads."""
    loads = np.array([1.0, 2.0]) * subject.scales.load
    stick = subject.scales.stick
    amplitude = min(subject.scales.slip, 8.0 * stick) if stick > 0 else subject.scales.slip
    size = amplitude / _QUARTER
    signs = [1] * _QUARTER + [-1] * 2 * _QUARTER + [1] * 2 * _QUARTER
    dt = size / _rate_scale(subject)
    steps = [_together(subject, 0.0, loads, subject.scales.dt)]
    steps += [_together(subject, sign * size, loads, dt) for sign in signs]
    answers = _all(subject, Case(tuple(steps)))
    motion = np.cumsum([0.0, *(sign * size for sign in signs)])
    along = np.array([_along(subject, a) for a in answers])
    still = not _varies(subject, along[1:])
    if subject.interface.name in COEFFICIENT and still:
        raise Refused(
            f"The coefficient is {along[-1, 0]:.6g} throughout a cycle: it does not depend on slip."
        )
    return {
        "motion": motion.tolist(),
        "turn": _QUARTER,  # increment at whose end the point turns round for the first time
        "loads": loads.tolist(),
        "friction": along.T.tolist(),
        "friction_name": friction_name(subject),
        "load_name": load_name(subject),
    }


def directions(subject: Subject) -> Data:
    """Friction over load of points that slide in all directions."""
    angles = 2.0 * math.pi * np.arange(_ANGLES) / _ANGLES
    along = np.array([np.cos(angles), np.sin(angles)])
    loads = np.full(_ANGLES, subject.scales.load)
    case = _steady(subject, loads, _rate_scale(subject))
    touch, *slides = case.steps
    motion = tuple(map(tuple, (subject.scales.slip * along.T).tolist()))
    answer = _last(subject, Case((touch, *(replace(s, motion=motion) for s in slides))))
    size = _ratio(subject, answer, loads)
    if not np.isfinite(size).all():
        raise _no_slip(subject)
    if not size.max() > 0:
        raise Refused("Friction is zero in all directions of sliding.")
    assert answer.friction is not None
    friction = np.array(answer.friction, dtype=float) / loads
    off = np.abs(friction - size * along).max()
    if not _varies(subject, size) and off <= _DIRECTION[subject.precision] * size.max():
        raise Refused("Friction has the same size in all directions of sliding, and opposes it.")
    with np.errstate(invalid="ignore", divide="ignore"):
        cosine = (friction * along).sum(axis=0) / size
    angle = math.degrees(np.arccos(np.clip(np.nanmin(cosine), -1.0, 1.0)))
    return {"friction": friction.tolist(), "angle": float(angle), "ratio": ratio_name(subject)}


def dependence(subject: Subject) -> Data:
    """Friction over load along each of temperature and field variables that it depends on."""
    curves, without = [], []
    for index in range(-int(subject.temperatures), subject.fields):
        name, values = _sweep(subject, index)
        loads = np.full(values.size, subject.scales.load)
        case = _steady(subject, loads, _rate_scale(subject))
        steps = tuple(_swept(subject, s, index, values) for s in case.steps)
        found = _signed(subject, _last(subject, Case(steps)), loads)
        if not np.isfinite(found).any() or not _varies(subject, found):
            without.append(name)
        else:
            curves.append({"name": name, "x": values.tolist(), "y": found.tolist()})
    if not curves:
        read = " and ".join(without) or "temperature and field variables"
        raise Refused(f"Friction does not depend on {read}.")
    return {"curves": curves, "without": without, "ratio": ratio_name(subject)}


def stick_force(subject: Subject) -> Data:
    """Friction force against the stick force, both over the normal force (VFRIC, VFRICTION)."""
    one = np.full(1, subject.scales.load)
    free = _signed(subject, _last(subject, _steady(subject, one, _rate_scale(subject))), one)[0]
    if math.isnan(free):
        raise _no_slip(subject)
    if not free > 0:
        raise Refused("There is no friction force against the slip, whatever the stick force.")
    held = np.linspace(0.0, 2.0 * free, 61)
    loads = np.full(held.size, subject.scales.load)
    case = _steady(subject, loads, _rate_scale(subject))
    limited = tuple(replace(s, stick=tuple((held * loads).tolist())) for s in case.steps)
    answer = _last(subject, Case(limited))
    return {"stick": held.tolist(), "force": _signed(subject, answer, loads).tolist()}


# Cases of the figures: point k stands under load k.


def _rate_scale(subject: Subject) -> float:
    return subject.scales.slip / subject.scales.dt


def _together(subject: Subject, motion: float, loads: np.ndarray, dt: float) -> Step:
    step = alike(subject, Step(((motion, 0.0),) * loads.size, tuple(loads.tolist()), dt))
    explicit = subject.interface.name in ("vfric", "vfriction")
    # No force is needed to hold a point that does not move.
    return replace(step, stick=(0.0,) * loads.size) if explicit and motion == 0 else step


def alike(subject: Subject, step: Step) -> Step:
    """The step with the same area, temperature and field variables at all points."""
    n = len(step.load)
    temperature, fields = None, None
    area = (1.0,) * n if subject.interface.name in ("vfric", "vfriction") else None
    if subject.temperatures:
        temperature = ((subject.scales.temperature,) * 2,) * n
    if subject.fields:
        fields = ((_field_values(subject),) * 2,) * n
    return replace(step, area=area, temperature=temperature, fields=fields)


def _steady(subject: Subject, loads: np.ndarray, rate: float) -> Case:
    slip = subject.scales.slip
    touch = _together(subject, 0.0, loads, subject.scales.dt)
    return Case((touch,) + (_together(subject, slip, loads, slip / float(rate)),) * _SLIDES)


def _field_values(subject: Subject) -> tuple[float, ...]:
    return subject.scales.fields or (0.5,) * subject.fields


def _sweep(subject: Subject, index: int) -> tuple[str, np.ndarray]:
    """Name and values of the temperature (index -1) or of a field variable (from 0)."""
    if index < 0:
        base = subject.scales.temperature
        reach = max(abs(base), 1.0)
        return "temperature", np.linspace(base - reach, base + 25.0 * reach, 53)
    base = _field_values(subject)[index]
    reach = max(abs(base), 1.0)
    return f"field variable {index + 1}", np.linspace(base - reach, base + 3.0 * reach, 41)


def _swept(subject: Subject, step: Step, index: int, values: np.ndarray) -> Step:
    """The step with values of the temperature or of a field variable that differ by point."""
    if index < 0:
        return replace(step, temperature=tuple((float(t), float(t)) for t in values))
    base, fields = _field_values(subject), []
    for value in values.tolist():
        fields.append(((*base[:index], value, *base[index + 1 :]),) * 2)
    return replace(step, fields=tuple(fields))


# From answers to numbers.


def _all(subject: Subject, case: Case) -> Sequence[Answer]:
    answers = subject.respond(case)
    failure = answers[-1].failure
    if failure is not None:
        raise failure
    return answers


def _last(subject: Subject, case: Case) -> Answer:
    return _all(subject, case)[-1]


def _ratio(subject: Subject, answer: Answer, loads: np.ndarray) -> np.ndarray:
    if answer.friction is None:
        assert answer.coefficient is not None
        return np.array(answer.coefficient, dtype=float)
    friction = np.array(answer.friction, dtype=float)
    ratio = np.hypot.reduce(friction, axis=0) / loads
    if answer.lm is not None:  # a point that sticks rigidly has the multiplier as its friction
        return np.where(answer.lm == 1, math.nan, ratio)
    # The stick force holds it, friction would be larger.
    return np.where(ratio >= AMPLE * (1.0 - 1e-6), math.nan, ratio)


def _signed(subject: Subject, answer: Answer, loads: np.ndarray) -> np.ndarray:
    """Friction over load, below zero where it pushes along a motion in direction 1."""
    ratio = _ratio(subject, answer, loads)
    return ratio if answer.friction is None else np.copysign(ratio, answer.friction[0] + 0.0)


def _no_slip(subject: Subject) -> Refused:
    if subject.interface.name == "fric":
        return Refused("The routine lets no point slip here (LM = 1).")
    return Refused(f"Friction is {AMPLE:g} times the normal force or more: no point slips.")


def _along(subject: Subject, answer: Answer) -> np.ndarray:
    if answer.friction is None:
        assert answer.coefficient is not None
        return np.array(answer.coefficient, dtype=float)
    return np.array(answer.friction[0], dtype=float)


def _wide(values: np.ndarray) -> bool:
    """Whether the values are positive and differ so much that only logarithms show them all."""
    finite = values[np.isfinite(values)]
    return bool(finite.size and finite.min() > 0 and finite.max() > _WIDE * finite.min())


def _varies(subject: Subject, values: np.ndarray) -> bool:
    """Whether the finite values differ by more than rounding."""
    finite = values[np.isfinite(values)]
    if finite.size == 0:
        return False
    top = np.abs(finite).max()
    return bool(finite.max() - finite.min() > _ROUNDING[subject.precision] * top)
