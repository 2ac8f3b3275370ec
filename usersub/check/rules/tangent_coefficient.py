# SPDX-License-Identifier: MIT
"""fCoefDeriv of FRIC_COEF against differences of the coefficient, by calls of the routine alone."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from usersub.check.case import Case
from usersub.check.probing.differences import Derivative, derivative
from usersub.check.probing.raw import RawCall
from usersub.check.probing.response_of import ask, straight
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules.figures import number
from usersub.check.subject import Subject

_RIGHT = 1e-5
_DOUBTS = 20.0
#: Angles of the slip rate, factors on its size, on the pressure and on the temperature.
_PLACES = (
    (0.5, 1.0, 1.0, 1.0),
    (2.2, 30.0, 0.3, 1.3),
    (-0.4, 0.02, 2.0, 1.7),
    (3.6, 1e3, 100.0, 2.5),
)


@dataclass(frozen=True)
class _At:
    """Where the coefficient is asked for: motion of the increment, pressure, temperature."""

    motion: tuple[float, float]
    pressure: float
    temperature: float
    dt: float


def _places(subject: Subject) -> Iterator[Case]:
    for angle, rate, load, heat in _PLACES:
        last = straight(subject, angle, (rate,), load=load).steps[-1]
        temperature = heat * subject.scales.temperature
        yield Case((replace(last, temperature=((temperature, temperature),)),))


@rule(
    "tangent.coefficient",
    "fCoefDeriv holds the derivatives of the coefficient by slip rate, pressure and temperature.",
    reference="slots 1 to 3 of fCoefDeriv; since 2022 also by the components of the slip rate (4, "
    "5), by the equivalent slip (6) and by the slip (7, 8)",
    interfaces=("fric_coef",),
    cases=_places,
)
def coefficient(subject: Subject, case: Case) -> Finding | None:
    """Slip, pressure and temperature change, one after the other, as in an increment of a host."""
    ask(subject, case)  # a routine that fails is not called without guard
    step = case.steps[-1]
    if step.dt <= 0:
        return None
    motion = (*step.motion[0], 0.0)[:2]
    heat = step.temperature[0][0] if step.temperature else subject.scales.temperature
    at = _At((motion[0], motion[1]), step.load[0], heat, step.dt)
    call = RawCall(subject, 1, case.directions + 1)
    count = 2 if subject.anisotropic and case.directions == 2 else 1
    whole = _given(call, at)
    for which in range(count):
        found = _wrong(call, at, whole[:, which], which, subject)
        if found is not None:
            if not np.any(whole):
                raise NotApplicable(
                    f"the routine leaves fCoefDeriv at 0, which slows Newton's method but changes "
                    f"no result ({found.detail})"
                )
            return found
    return None


def _wrong(
    call: RawCall, at: _At, given: np.ndarray, which: int, subject: Subject
) -> Finding | None:
    """The first derivative that does not fit."""
    length = math.hypot(*at.motion)
    along = np.array(at.motion) / length if length else np.array([1.0, 0.0])
    across = np.array([-along[1], along[0]])

    def coefficient(at: _At) -> np.ndarray:
        return np.array([_value(call, at, which)])

    def moved(way: np.ndarray, h: float) -> _At:
        motion = (at.motion[0] + h * float(way[0]), at.motion[1] + h * float(way[1]))
        return _At(motion, at.pressure, at.temperature, at.dt)

    slots = np.zeros(8)
    slots[: min(8, len(given))] = given[:8]
    by_components = slots[3:5] / at.dt + slots[6:8]
    checks: list[tuple[str, str, float, Derivative, float]] = []
    if length:
        sum_along = slots[0] / at.dt + slots[5] + float(by_components @ along)
        found = derivative(lambda h: coefficient(moved(along, h)), length)
        checks.append(("slots 1 and 4 to 8", "the slip rate", sum_along, found, at.dt))
        if len(given) > 3:
            found = derivative(lambda h: coefficient(moved(across, h)), length)
            sum_across = float(by_components @ across)
            checks.append(("slots 4, 5, 7, 8", "the slip rate across it", sum_across, found, at.dt))
    if at.pressure:
        found = derivative(
            lambda h: coefficient(_At(at.motion, at.pressure + h, at.temperature, at.dt)),
            abs(at.pressure),
        )
        checks.append(("slot 2", "the pressure", slots[1], found, 1.0))
    if subject.temperatures:
        found = derivative(
            lambda h: coefficient(_At(at.motion, at.pressure, at.temperature + h, at.dt)),
            max(abs(at.temperature), 1.0),
        )
        checks.append(("slot 3", "the temperature", slots[2], found, 1.0))
    wanted = [float(right.value[0]) * per for _, _, _, right, per in checks]
    for slot, by, told, right, per in checks:
        finding = _compared(slot, by, told, right, per, which, slots)
        if finding is not None:
            return replace(finding, hint=finding.hint + _elsewhere(checks, wanted, slots))
    return None


def _elsewhere(checks: list, wanted: list[float], slots: np.ndarray) -> str:
    """Which derivative stands in the slot of another, in words."""
    places = {"the slip rate": 0, "the pressure": 1, "the temperature": 2}
    right = {by: w for (_, by, *_), w in zip(checks, wanted, strict=True) if by in places and w}
    for by, value in right.items():
        for other, slot in places.items():
            fits = abs(float(slots[slot]) - value) <= _RIGHT * abs(value)
            if other != by and fits and slots[places[by]] != slots[slot]:
                return (
                    f"; what stands in slot {slot + 1} is the derivative by {by} and belongs into "
                    f"slot {places[by] + 1}"
                )
    return ""


def _compared(
    slot: str,
    by: str,
    told: float,
    right: Derivative,
    per: float,
    which: int,
    slots: np.ndarray,
) -> Finding | None:
    value, doubt = float(right.value[0]), float(right.doubt[0])
    allowed = _RIGHT * max(abs(told), abs(value)) + _DOUBTS * doubt
    if right.kink[0] or abs(told - value) <= allowed:
        return None
    if slot.startswith("slots 1") and not np.any(slots[3:]):
        slot = "slot 1"
    also = ""
    if abs(told + value) <= allowed:
        also = " (the opposite sign fits)"
    elif not np.any(slots):
        also = " (all slots are 0)"
    name = "fCoefDeriv" if which == 0 else "fCoefDeriv of the second coefficient"
    return Finding(
        f"{name}, {slot}, gives {number(told * per)} as derivative by {by}; expected "
        f"{value * per:.8g} by differences{also}",
        hint="slot 1 is the derivative by the slip rate, 2 by the pressure, 3 by the temperature",
        figures={"step": 0, "point": 0, "given": told * per, "differences": value * per},
    )


def _set(call: RawCall, at: _At) -> None:
    call.restore()
    rate = [m / at.dt for m in at.motion]
    size, length = math.hypot(*rate), math.hypot(*at.motion)
    if "slipData" in call:
        call["slipData"] = (size, *rate, length, *at.motion)
    else:
        call["slipRate"] = size
    call["pressure"], call["tempAvg"] = at.pressure, at.temperature
    data = call["rData"]
    data[:3] = at.dt


def _run(call: RawCall) -> None:
    if call.run() < 0:
        raise CannotCheck("the routine raised an exception")


def _value(call: RawCall, at: _At, which: int) -> float:
    _set(call, at)
    _run(call)
    return float(call["fCoef"].ravel(order="F")[which])


def _given(call: RawCall, at: _At) -> np.ndarray:
    """Derivatives that the routine gives, shape (slots, coefficients)."""
    _set(call, at)
    _run(call)
    found = np.array(call["fCoefDeriv"][0])
    return found.reshape(found.shape[0], -1)
