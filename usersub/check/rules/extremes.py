# SPDX-License-Identifier: MIT
"""Numbers at the ends of their range, and what is no number at all."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from usersub.check import cases
from usersub.check.case import Case, Step
from usersub.check.probing import spreading
from usersub.check.probing.raw import RawCall
from usersub.check.respond.answer import Answer
from usersub.check.rule import CannotCheck, Finding, rule
from usersub.check.subject import Subject
from usersub.driver.status import VALUES

#: Decimal exponents of motions, loads and time increments, the mildest first: those that a
#: diverging analysis may pass, those beyond, denormal numbers. The largest whose square is finite.
_NEAR = {"double": (30, -30), "single": (10, -10)}
_FAR = {
    "double": (100, -100, 140, -140, 170, -170, 250, -250, 300, -300),
    "single": (16, -16, 21, -21, 30, -30, -36),
}
_DENORMAL = {"double": (-310, -323), "single": (-42, -45)}
_PRODUCTS = {"double": 150, "single": 15}
#: Largest size that counts as representable, and the step towards ordinary numbers.
_REACH = {"double": (1e300, 1e10), "single": (1e36, 1e4)}

_WRONG = re.compile(
    r"the routine (?:returned|left) (?P<what>.*?)(?:, element \d+)? = -?(?P<is>nan|inf)"
)


def unusual(subject: Subject) -> Iterator[Case]:
    """Motions, loads and time increments that are very small or large."""
    for exponent in _NEAR[subject.precision]:
        yield from _of_exponent(subject, exponent)


def beyond(subject: Subject) -> Iterator[Case]:
    """The same from there to the ends of the range."""
    for exponent in (*_FAR[subject.precision], *_DENORMAL[subject.precision]):
        yield from _of_exponent(subject, exponent)


def _of_exponent(subject: Subject, exponent: int) -> Iterator[Case]:
    """One or two numbers of a size at a time."""
    slip, load, dt = subject.scales.slip, subject.scales.load, subject.scales.dt
    size, most = _power(exponent, subject.precision), _PRODUCTS[subject.precision]
    yield _case(subject, size, load, dt)
    yield _case(subject, slip, size, dt)
    if exponent <= most:
        yield _case(subject, size, size, dt)
    # Times are added up, so that a denormal increment would be lost, and dividing by it is the
    # host's overflow.
    if abs(exponent) < most:
        yield _case(subject, slip, load, size)


def _power(exponent: int, precision: str) -> float:
    """10**exponent, the smallest positive number where that is smaller."""
    smallest = 5e-324 if precision == "double" else 1.4e-45
    return max(10.0**exponent, smallest)


def _case(subject: Subject, slip: float, load: float, dt: float) -> Case:
    """An ordinary contact, then a motion and another across it, so that no sum of them is zero."""
    near, far = 0.6 * slip or slip, 0.8 * slip or slip
    steps = [Step((motion,), (load,), dt) for motion in ((far, near), (-near, far))]
    return Case((cases.touch(subject), *steps))


@rule(
    "extremes.finite",
    "Finite input, from 1e-30 to 1e30, gives finite friction or a cut-back.",
    reference="iterations that diverge pass such numbers before the host cuts the increment back",
    cases=unusual,
    seconds=20.0,
)
def finite(subject: Subject, case: Case) -> Finding | None:
    """NaN is a fault; infinity is one where milder cases show that the answer is finite."""
    return _not_finite(subject, case)


@rule(
    "extremes.far",
    "The same holds to the ends of the range, 1e300 and denormal numbers.",
    reference="|x| as sqrt(x*x + y*y) overflows above 1e154 and is zero below 1e-162, where "
    "hypot does neither; no contact moves so far, so this is only told",
    severity="note",
    cases=beyond,
    seconds=20.0,
)
def far(subject: Subject, case: Case) -> Finding | None:
    """As extremes.finite."""
    return _not_finite(subject, case)


def _not_finite(subject: Subject, case: Case) -> Finding | None:
    if case.directions != 2 or not _is_unusual(subject, case):
        return None
    answers = subject.respond(case)
    failure, step = answers[-1].failure, len(answers) - 1
    if failure is None or failure.status != VALUES["NOT_FINITE"]:
        return None
    wrong = _WRONG.search(str(failure))
    if wrong is None or step == 0:
        return None
    if _is_denormal(subject, case) and (
        wrong["is"] == "inf" or re.split(r"\W", wrong["what"])[0] not in _RESULTS
    ):
        return None
    if wrong["is"] == "inf" and not _representable(subject, case, step, wrong["what"]):
        return None
    return Finding(
        f"{str(failure)}: {'the input is finite' if wrong['is'] == 'nan' else _NO_OVERFLOW}",
        hint="Use hypot or divide by the largest component first, and do not divide by what can "
        "be zero.",
        figures={"step": step, "point": 0},
    )


def _is_unusual(subject: Subject, case: Case) -> bool:
    """Whether a number is far from the scales: a case that was made smaller may be ordinary."""
    scales, far = subject.scales, _UNUSUAL[subject.precision]
    ratios = [
        abs(value) / scale
        for s in case.steps
        for scale, numbers in (
            (scales.slip, [c for m in s.motion for c in m]),
            (scales.load, list(s.load)),
            (scales.dt, [s.dt]),
        )
        for value in numbers
        if value
    ]
    return any(ratio > far or ratio < 1 / far for ratio in ratios)


#: How many times a scale is far from it.
_UNUSUAL = {"double": 1e20, "single": 1e7}
#: What has to be right for denormal numbers too: what is divided by them, as derivatives are, or by
#: ratios of them, may overflow by itself.
_RESULTS = ("TAU", "fTangential", "fCoef", "state")


def _is_denormal(subject: Subject, case: Case) -> bool:
    smallest = np.finfo(np.float64 if subject.precision == "double" else np.float32).tiny
    numbers = [c for s in case.steps for c in (*s.load, *(c for m in s.motion for c in m))]
    return any(0 < abs(number) < smallest for number in numbers)


_NO_OVERFLOW = "the input is finite, and what smaller inputs give shows that so is the answer"


def _representable(subject: Subject, case: Case, step: int, what: str) -> bool:
    """Whether the answers of milder cases, continued, are far from overflow."""
    reach, factor = _REACH[subject.precision]
    sizes: list[float] = []
    for times in range(1, _MILDER + 1):
        answer = subject.respond(_milder(subject, case, factor**times))[-1]
        size = _size(answer, what)
        if size is None:
            sizes.clear()
        elif size == 0.0:
            return False
        else:
            sizes.append(math.log10(size))
        if len(sizes) == 2:
            # The change from one step to the next, once more for every step towards the case.
            return sizes[0] + (times - 1) * (sizes[0] - sizes[1]) < math.log10(reach)
    return False


#: Steps towards ordinary numbers that are looked at.
_MILDER = 5


def _milder(subject: Subject, case: Case, factor: float) -> Case:
    """The case with its unusual numbers brought nearer to the scales by a factor."""
    scales = subject.scales

    def nearer(value: float, scale: float) -> float:
        ratio = abs(value) / scale
        if ratio > 10 * factor:
            return value / factor
        return value * factor if 0 < ratio < 0.1 / factor else value

    steps = tuple(
        replace(
            s,
            motion=tuple(tuple(nearer(c, scales.slip) for c in m) for m in s.motion),
            load=tuple(nearer(p, scales.load) for p in s.load),
            dt=nearer(s.dt, scales.dt),
        )
        for s in case.steps
    )
    return case.but(steps=steps)


_ARRAYS = {
    "TAU": "friction",
    "fTangential": "friction",
    "fCoef": "coefficient",
    "DDTDDG": "tangent",
    "DDTDDP": "by_pressure",
    "DDTDDT": "by_temperature",
    "fCoefDeriv": "derivative",
    "DSLIP": "dslip",
    "SED": "sed",
    "SFD": "sfd",
    "state": "state",
}


def _size(answer: Answer, what: str) -> float | None:
    """Largest element of the array that a message names; None if it is not finite."""
    name = _ARRAYS.get(re.split(r"\W", what)[0], "")
    array = getattr(answer, name) if name else None
    size = float(np.abs(array).max()) if array is not None and array.size else math.nan
    return size if math.isfinite(size) else None


# NaN.

_POINTS = 3


@rule(
    "extremes.not-a-number",
    "NaN in the input of one point stays in that point, and no call crashes or hangs on it.",
    reference="what one point of a diverging analysis passes must not spread over the block",
    seconds=20.0,
)
def not_a_number(subject: Subject) -> Iterator[Finding]:
    """Calls with made arguments, since the drivers refuse NaN."""
    name = subject.interface.name
    block = subject.interface.solver == "explicit"
    call = RawCall(subject, _POINTS if block else 1)
    plain = spreading.outputs_of(call)
    if plain is None or spreading.unlike_point(
        call, plain, spreading.outputs_of(call), range(call.points)
    ):
        raise CannotCheck("an ordinary call does not come back, or does not repeat itself")
    for argument in spreading.INPUTS[name]:
        if argument not in call or not call[argument].size:
            continue
        if spreading.coupled(call, argument, plain):
            raise CannotCheck("points depend on each other without NaN too; see blocks.permute")
        if found := spreading.spread(call, argument, plain):
            yield found
            return
