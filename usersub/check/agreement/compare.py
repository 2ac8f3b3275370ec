# SPDX-License-Identifier: MIT
"""Comparing a routine with a built-in law: which differences rounding explains, and which not."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from usersub.check.agreement import truth as law_truth
from usersub.check.case import Case, Step
from usersub.check.respond import Answer, run_of
from usersub.check.rule import Finding
from usersub.errors import Error
from usersub.laws.parts import Accuracy

if TYPE_CHECKING:
    from usersub.check.subject import Subject
    from usersub.laws.description import Law

#: Relative difference that rounding of another formula may make, beyond what the inputs' rounding
#: makes: two decades above 2 units of 1e-16 over a history of cancellations; in single precision
#: the same over 1e-7.
TOLERANCE = {"double": 1e-10, "single": 2e-5}
#: What a law states of its accuracy where it says nothing of its own (`usersub.laws.parts`).
_ORDINARY = Accuracy()
#: Units in the last place by which the inputs are moved to see what their rounding does.
_MOVED = 16.0
#: State variables of single precision between this and its inverse keep their digits; laws bound
#: their exponents before numbers end.
_SMALLEST = 1e-20
#: Characteristic length behind FRIC: not one, so that it is not left out unseen.
_LENGTH = 2.5
#: Times the smallest number with all digits: what is less may be lost on the way.
_UNDERFLOW = 1e3
#: Turn of the axes behind FRIC between increments (radian), in a second run.
_TURN = 0.375

#: Names of results in messages.
_NAMES = {
    "fric": {
        "friction": "TAU({})", "tangent": "DDTDDG({},{})", "by_pressure": "DDTDDP({})",
        "by_temperature": "DDTDDT({},{})", "dslip": "DSLIP({})", "lm": "LM", "sed": "SED",
        "sfd": "SFD", "state": "STATEV({})",
    },
    "": {
        "friction": "the friction in direction {}", "coefficient": "fCoef",
        "second": "the second coefficient", "derivative": "derivative {} of the coefficient",
        "tangent": "derivative of friction {} by motion {}",
        "by_pressure": "derivative of friction {} by pressure",
        "by_temperature": "derivative of friction {} by temperature {}",
        "dslip": "the slip in direction {}", "lm": "LM", "sed": "the elastic energy",
        "sfd": "the dissipation", "state": "state variable {}",
    },
}  # fmt: skip


@dataclass(frozen=True)
class Way:
    """How a case is run."""

    turned: bool = False
    enforced: bool = False
    turn: float = _TURN


def tolerance(law: Law, precision: str) -> float:
    """Relative difference that is nothing, more where the law states less accuracy."""
    stated = law.accuracy
    if precision == "single":
        return TOLERANCE[precision] * stated.single_ulp / _ORDINARY.single_ulp
    return TOLERANCE[precision] * stated.ulp / _ORDINARY.ulp


def respond_to(subject: Subject, case: Case, way: Way) -> list[Answer]:
    """The answers, with a characteristic length and, if wanted, axes that turn."""
    subject.under_way(case)
    standard = subject.interface.name == "fric" or (
        way.enforced and subject.interface.name == "fric_coef"
    )
    options = {"characteristic_length": _LENGTH} if standard else {}
    answers: list[Answer] = []
    try:
        run = run_of(subject, case, enforced=way.enforced, **options)
        for index in range(len(case.steps)):
            if way.turned and index:
                angle = way.turn * index * np.arange(1, case.points + 1)
                c, s = np.cos(angle), np.sin(angle)
                run.driver.bind(rotation=np.asfortranarray(np.array([[c, -s], [s, c]])))
            answers.append(run.step(index))
    except Error as error:
        answers.append(Answer(failure=error))
    return answers


# Comparing.


class Comparison:
    """Answers of the routine and of the law to one case, run in one way."""

    def __init__(self, ours: Subject, truth: Subject, law: Law, case: Case, way: Way) -> None:
        self.ours, self.truth, self.law, self.case, self.way = ours, truth, law, case, way
        self.relative = tolerance(law, ours.precision)
        #: Whether the state variables of both are the same, in the same order.
        self.layout = True
        self.spreads: dict[int, list[dict[str, np.ndarray]]] = {}

    def finding(self) -> Finding | None:
        """The first difference that rounding does not explain."""
        wanted = respond_to(self.truth, self.case, self.way)
        found = respond_to(self.ours, self.case, self.way)
        if self._same(wanted, found):
            return None
        scales = Scales(self.case, self.law, self.truth.props, self.ours.precision)
        real = np.float32 if self.ours.precision == "single" else np.float64
        nothing = _UNDERFLOW * float(np.finfo(real).tiny)
        for index, exact in enumerate(wanted):
            if exact.failure is not None:  # the law refuses; what others do then is their affair
                return None
            if index >= len(found) or found[index].failure is not None:
                return self.failed(found[-1].failure, index)
            given = found[index].arrays()
            for name, values in exact.arrays().items():
                if name not in given or (name == "state" and not self._comparable(given[name])):
                    continue
                allowed = self._relative(name) * scales.of(name, index, values) + nothing
                off = worst(given[name], values, allowed)
                # What rounding of the inputs does to the law, then to the routine itself.
                for subject, answers in ((self.truth, wanted), (self.ours, found)):
                    if off is None:
                        break
                    spread = self._spread(subject, answers)[index].get(name)
                    if spread is not None and spread.shape == values.shape:
                        allowed = allowed + 4.0 * spread
                    off = worst(given[name], values, allowed)
                if off is not None and self.ours.precision == "single":
                    allowed = allowed + 4.0 * self._error_of_truth(wanted, index, name)
                    off = worst(given[name], values, allowed)
                if off is not None:
                    return self.different(name, index, off, given[name], values)
        return None

    def _same(self, wanted: list[Answer], found: list[Answer]) -> bool:
        """Whether all results are the same to the bit: then rounding has nothing to explain."""
        if len(wanted) != len(found):
            return False
        for exact, answer in zip(wanted, found, strict=True):
            if exact.failure is not None or answer.failure is not None:
                return False
            given = answer.arrays()
            for name, values in exact.arrays().items():
                skipped = name not in given or (name == "state" and not self.layout)
                if not skipped and not np.array_equal(given[name], values):
                    return False
        return True

    def _relative(self, name: str) -> float:
        """Scalar state variables may be exponentials of what the law rounds, which double
        precision tells: single precision shows no more than gross faults of them."""
        single = self.ours.precision == "single" and name == "state"
        return 100.0 * self.relative if single else self.relative

    def _comparable(self, state: np.ndarray) -> bool:
        return state.shape[0] >= self.truth.states and self.layout

    def _spread(self, subject: Subject, answers: list[Answer]) -> list[dict[str, np.ndarray]]:
        """How much answers change when the inputs are moved by some roundings; found once."""
        if id(subject) not in self.spreads:
            self.spreads[id(subject)] = self._moved_answers(subject, answers)
        return self.spreads[id(subject)]

    def _moved_answers(
        self, subject: Subject, answers: list[Answer]
    ) -> list[dict[str, np.ndarray]]:
        spread = [{n: np.zeros_like(a, float) for n, a in w.arrays().items()} for w in answers]
        for factor, moved, props in _moved(self.case, subject, rest=subject is self.truth):
            way = replace(self.way, turn=_TURN * factor)
            others = respond_to(subject.but(props=props), moved, way)
            for index, sums in enumerate(spread):
                there = others[index].arrays() if index < len(others) else {}
                here = answers[index].arrays()
                for name in sums:
                    if name not in there:
                        sums[name][...] = np.inf
                    else:
                        sums[name] += np.abs(there[name] - here[name])
        return spread

    def _error_of_truth(self, wanted: list[Answer], index: int, name: str) -> np.ndarray:
        """How far the law in single precision is from itself in double: numbers beyond the range
        or the digits of single precision prove nothing. Infinite where that is not known."""
        twin = law_truth.twin(self.truth.but(precision="double", path=None), self.law)
        real = np.float32
        props = tuple(float(real(p)) for p in self.truth.props)
        answers = respond_to(twin.but(props=props), self.case.but(props=props), self.way)
        here = wanted[index].arrays()[name]
        there = answers[index].arrays().get(name) if index < len(answers) else None
        if there is None or there.shape != here.shape:
            return np.full(here.shape, np.inf)
        # Below the smallest number even the first digit is lost, for all increments after it.
        sizes = [np.abs(a.state[a.state != 0]) for a in answers[: index + 1] if a.state is not None]
        if any((s < _SMALLEST).any() or (s > 1 / _SMALLEST).any() for s in sizes):
            return np.full(here.shape, np.inf)
        return np.abs(there - here)

    # Words.

    def failed(self, failure: Error | None, index: int) -> Finding:
        return Finding(
            f"the routine fails in step {index + 1}, the built-in law {self.law.name} does not: "
            f"{failure}",
            figures={"step": index},
        )

    def different(
        self, name: str, index: int, place: tuple[int, ...], found: np.ndarray, exact: np.ndarray
    ) -> Finding:
        face = self.ours.interface.name
        names = _NAMES["fric"] if face == "fric" else _NAMES[""]
        told = names.get(name, name).format(*(i + 1 for i in place[:-1]))
        return Finding(
            f"{told} of point {place[-1] + 1} is {found[place]:.12g} in step {index + 1}; the "
            f"built-in law {self.law.name} gives {exact[place]:.12g}{self._how()}",
            figures={
                "step": index, "point": place[-1],
                "found": float(found[place]), "expected": float(exact[place]),
            },
        )  # fmt: skip

    def _how(self) -> str:
        if self.way.turned:
            return ", with local axes that turn between the increments (DROT)"
        if self.way.enforced:
            return ", with the driver's enforcement of the coefficient"
        return ""


def worst(found: np.ndarray, exact: np.ndarray, allowed: np.ndarray) -> tuple[int, ...] | None:
    """Index of the largest difference beyond what is allowed; None if there is none."""
    if found.shape != exact.shape:  # state variables beyond those of the law
        found = found[tuple(slice(n) for n in exact.shape)]
    if np.array_equal(found, exact):
        return None
    with np.errstate(invalid="ignore"):
        same = (found == exact) | (np.abs(found - exact) <= allowed) | np.isnan(exact)
    if same.all():
        return None
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        beyond = np.where(same, -1.0, np.abs(found - exact) / np.maximum(allowed, 1e-300))
    beyond = np.where(~same & ~np.isfinite(beyond), np.inf, beyond)
    return tuple(int(i) for i in np.unravel_index(np.argmax(beyond), beyond.shape))


class Scales:
    """How large each result may be expected, where it vanishes by itself: rounding of what was
    added to it before remains there."""

    def __init__(self, case: Case, law: Law, props: Sequence[float], precision: str) -> None:
        self.case, self.law = case, law
        self.vectors, self.scalars = 0, law.count(props)[1]
        #: Times the tolerance it is some tens of roundings (single), or a thousand (double).
        self.share = 0.1 if precision == "single" else 1e-3
        self.largest: dict[str, np.ndarray] = {}
        lengths = [[math.hypot(*m) for m in s.motion] for s in case.steps]
        # Up to and with each step.
        self.way = np.maximum.accumulate(np.array(lengths))
        self.load = np.maximum.accumulate(np.abs(np.array([s.load for s in case.steps])))

    def of(self, name: str, index: int, values: np.ndarray) -> np.ndarray:
        """Scale of every entry of a result: the largest one of its kind at the point, or a share of
        what that was before or of what forces and motions let expect."""
        size = np.abs(values)
        size[~np.isfinite(size)] = 0.0
        groups = self._groups(name, values)
        for rows in groups:
            size[rows] = size[rows].max(axis=tuple(range(values.ndim - 1)), initial=0.0)
        before = self.largest.get(name, size)
        self.largest[name] = np.maximum(before, size)
        least = self.share * self._expected(name, index)
        if values.ndim > 2 and least.ndim == 2:  # state variables of several nodes
            least = least.reshape(len(least), *(1,) * (values.ndim - 2), -1)
        return np.maximum(size, np.maximum(self.share * before, least))

    def _groups(self, name: str, values: np.ndarray) -> list[slice]:
        """Rows that belong together: components of a vector, but not numbers of different units."""
        if values.ndim < 2:
            return [slice(None)] if values.ndim == 2 else []
        if name == "derivative":
            return [slice(k, k + 1) for k in range(len(values))]
        if name == "state":
            vectors = self.vectors = max(len(values) - self.scalars, 0)
            return [slice(0, vectors), *(slice(k, k + 1) for k in range(vectors, len(values)))]
        return [slice(None)]

    def _expected(self, name: str, index: int) -> np.ndarray:
        way, load, dt = self.way[index], self.load[index], self.case.steps[index].dt
        safe, pressed = np.where(way > 0, way, 1.0), np.where(load > 0, load, 1.0)
        if name in ("friction", "by_temperature"):
            return load
        if name in ("coefficient", "second", "by_pressure"):
            return np.ones_like(load)
        if name == "tangent":
            return load / safe
        if name == "derivative":
            return np.array([dt / safe, 1.0 / pressed, np.full_like(load, 1e-3)])
        if name in ("sed", "sfd"):
            return load * way
        if name == "dslip":
            return way
        return self._of_state(way, load) if name == "state" else np.zeros_like(load)

    def _of_state(self, way: np.ndarray, load: np.ndarray) -> np.ndarray:
        """Vectors are elastic slips, or what their units say; nothing is known of scalars."""
        units = {v.unit for v in self.law.vectors}
        vector = load if units == {"stress"} else way
        rows = [vector] * self.vectors + [np.zeros_like(load)] * self.scalars
        return np.array(rows) if rows else np.zeros_like(load)


def _moved(
    case: Case, subject: Subject, rest: bool
) -> Iterator[tuple[float, Case, tuple[float, ...]]]:
    """The case with every input moved by some units in the last place, one kind after the other,
    and the factor by which; with `rest`, motions of nothing too: what the law does there is its
    affair, but a routine has to do the same."""
    real = np.float32 if subject.precision == "single" else np.float64
    unit = _MOVED * float(np.finfo(real).eps)
    way = max(math.hypot(*m) for s in case.steps for m in s.motion)
    props = subject.props
    for factor in (1.0 + unit, 1.0 - unit):
        other = 2.0 - factor
        changes: tuple[Callable[[int, Step], Step], ...] = (
            lambda k, s: _scaled(s, motion=factor),  # noqa: B023 - used before the next round
            *([lambda k, s: _nudged(s, (factor - 1.0) * way)] * rest),  # noqa: B023
            lambda k, s: _scaled(s, load=factor),  # noqa: B023
            # So that forces of the increment before are not those of the limit now.
            lambda k, s: _scaled(s, load=factor if k % 2 else other),  # noqa: B023
            lambda k, s: _scaled(s, around=factor),  # noqa: B023
        )
        for change in changes:
            steps = tuple(change(k, s) for k, s in enumerate(case.steps))
            yield factor, case.but(steps=steps), props
        factors = [factor if k % 2 else 2.0 - factor for k in range(len(props))]
        moved = tuple(p if p == round(p) else p * f for p, f in zip(props, factors, strict=True))
        yield factor, case.but(props=moved), moved


def _nudged(step: Step, length: float) -> Step:
    """Every component of every motion moved by a length: at rest derivatives may have a side."""
    return replace(step, motion=tuple(tuple(c + length for c in m) for m in step.motion))


def _scaled(step: Step, motion: float = 1.0, load: float = 1.0, around: float = 1.0) -> Step:
    temperature, fields = step.temperature, step.fields
    return replace(
        step,
        motion=tuple(tuple(c * motion for c in m) for m in step.motion),
        load=tuple(p * load for p in step.load),
        stick=None if step.stick is None else tuple(p * load for p in step.stick),
        temperature=temperature and tuple((a * around, b * around) for a, b in temperature),
        fields=fields
        and tuple((tuple(x * around for x in a), tuple(x * around for x in b)) for a, b in fields),
    )
