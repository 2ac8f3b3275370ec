# SPDX-License-Identifier: MIT
"""Tangents of FRIC, entry by entry, against differences of its own answers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from usersub.check import cases
from usersub.check.case import Case
from usersub.check.probing.differences import Derivative, derivative
from usersub.check.respond import run_of
from usersub.check.respond.answer import Answer
from usersub.check.rule import CannotCheck, Finding, NotApplicable, rule
from usersub.check.rules import tangent_coefficient
from usersub.check.rules.figures import number
from usersub.check.subject import Subject
from usersub.errors import Error

__all__ = ["by_pressure", "by_slip", "by_temperature", "tangent_coefficient", "unsymmetric"]

#: Relative error of a tangent that differences cannot explain.
_RIGHT = 1e-5
#: How many times the doubt of a difference counts as possible.
_DOUBTS = 20.0


def _histories(subject: Subject) -> Iterator[Case]:
    stick = subject.scales.stick or 1e-3 * subject.scales.slip
    for directions in (1, 2):
        more: dict[str, Any] = {"directions": directions}
        yield cases.history(subject, [(0.3, 0.2)], unit=stick, **more)
        yield cases.history(subject, [(1.0, 0.4)], load=1.5, **more)
        yield cases.history(subject, [(1.0, 0.4), (0.7, 0.5)], **more)
        yield cases.history(subject, [(1.0, 0.4), (-0.5, 1.2)], load=0.8, **more)
        yield cases.history(subject, [(1.3, 0.2), (0.03, -0.04)], load=1.2, **more)
        yield from cases.loaded(subject, [(1.0, 0.4), (0.7, 0.5)], directions)


class _Last:
    """The last increment of a case, again and again from the same committed state."""

    def __init__(self, subject: Subject, case: Case) -> None:
        self.subject = subject
        self.case, self.index = case, len(case.steps) - 1
        subject.under_way(case)
        self.run = run_of(subject, case)
        try:
            for index in range(self.index):
                self.run.step(index)
        except Error as error:
            raise CannotCheck(f"the routine failed: {error}") from error

    def answer(self, **changes: Any) -> Answer:
        """What the last increment answers when its step is changed."""
        step = replace(self.case.steps[self.index], cut_back=True, **changes)
        self.run.case = self.case.but(steps=(*self.case.steps[:-1], step))
        try:
            return self.run.step(self.index)
        except Error as error:
            raise CannotCheck(f"the routine failed: {error}") from error

    def friction(self, **changes: Any) -> np.ndarray:
        """Friction of the first point, shape (F,)."""
        found = self.answer(**changes)
        assert found.friction is not None
        return np.array(found.friction[:, 0])


def _start(subject: Subject, case: Case) -> tuple[_Last, Answer] | None:
    """The last increment, if the stress there is the routine's."""
    last = _Last(subject, case)
    base = last.answer()
    if base.lm is not None and base.lm[0] != 0:
        return None
    return last, base


@rule(
    "tangent.slip",
    "DDTDDG is the derivative of the stress by the sliding motion, entry by entry.",
    reference="DDTDDG(a,b): row a is the stress, column b the motion; Newton's method needs it",
    interfaces=("fric",),
    cases=_histories,
)
def by_slip(subject: Subject, case: Case) -> Finding | None:
    """Stick, slip, turned slip and slip that has been taken back."""
    started = _start(subject, case)
    if started is None:
        return None
    last, base = started
    motion = case.steps[-1].motion[0]
    scale = float(np.linalg.norm(motion))
    if not scale:
        return None

    def column(of: int) -> Derivative:
        return derivative(lambda h: last.friction(motion=_shifted(motion, of, h)), scale)

    columns = [column(of) for of in range(case.directions)]
    assert base.tangent is not None
    return _judged(base.tangent[..., 0], columns, "DDTDDG", "the motion", case)


def _shifted(motion: tuple[float, ...], column: int, by: float) -> tuple[tuple[float, ...], ...]:
    return (tuple(x + by if c == column else x for c, x in enumerate(motion)),)


@rule(
    "tangent.pressure",
    "DDTDDP is the derivative of the stress by the pressure.",
    reference="DDTDDP is mu + p dmu/dp in slip; without it friction that depends on the pressure "
    "converges slowly, or not at all",
    interfaces=("fric",),
    cases=_histories,
)
def by_pressure(subject: Subject, case: Case) -> Finding | None:
    """The pressure of the last increment changes."""
    started = _start(subject, case)
    if started is None:
        return None
    last, base = started
    load = case.steps[-1].load[0]
    column = derivative(lambda h: last.friction(load=(load + h,)), abs(load))
    assert base.by_pressure is not None and base.friction is not None
    given = base.by_pressure[:, :1]
    found = _judged(given, [column], "DDTDDP", "the pressure", case)
    if found is None:
        return None
    secant = base.friction[:, 0] / load if load else 0.0
    if np.any(given) and np.allclose(given[:, 0], secant, rtol=1e-6, atol=0):
        hint = (
            "DDTDDP is the stress over the pressure, as for a constant mu; add p dmu/dp if the "
            "coefficient depends on the pressure, and the same for what else does (a stiffness)"
        )
        return replace(found, hint=hint)
    return found


@rule(
    "tangent.temperature",
    "DDTDDT is the derivative of the stress by the temperatures of both surfaces.",
    reference="DDTDDT(a,1) by the temperature of the secondary, DDTDDT(a,2) by that of the main "
    "surface; optional, for coupled thermal analyses",
    interfaces=("fric",),
    cases=_histories,
)
def by_temperature(subject: Subject, case: Case) -> Finding | None:
    """The temperatures of the last increment change, one after the other."""
    if not subject.temperatures:
        raise NotApplicable("the routine is checked without temperatures")
    started = _start(subject, case)
    if started is None:
        return None
    last, base = started
    own = case.steps[-1].temperature
    pair = own[0] if own else (subject.scales.temperature, subject.scales.temperature + 3.0)

    def column(surface: int) -> Derivative:
        def answer(h: float) -> np.ndarray:
            changed = tuple(t + h if s == surface else t for s, t in enumerate(pair))
            return last.friction(temperature=(changed,))

        return derivative(answer, max(abs(pair[surface]), 1.0))

    assert base.by_temperature is not None
    given = base.by_temperature[..., 0]
    found = _judged(given, [column(0), column(1)], "DDTDDT", "the temperature", case)
    if found is not None and not np.any(given):
        raise NotApplicable(
            "the routine leaves DDTDDT at 0 although its friction depends on temperature; it is "
            "optional, but a coupled analysis converges slowly without it"
        )
    return found


def _judged(
    given: np.ndarray, columns: list[Derivative], name: str, by: str, case: Case
) -> Finding | None:
    """What is wrong with a matrix of derivatives, the worst entry first."""
    value = np.array([c.value for c in columns]).T
    doubt = np.array([c.doubt for c in columns]).T
    kink = np.array([c.kink for c in columns]).T
    size = max(float(np.max(np.abs(given))), float(np.max(np.abs(value))))
    allowed = _RIGHT * size + _DOUBTS * doubt
    error = np.where(kink, 0.0, np.abs(given - value))
    if np.all(error <= allowed):
        return None
    row, column = (int(i) for i in np.unravel_index(np.argmax(error - allowed), error.shape))
    entry = (
        f"{name}({row + 1})"
        if len(columns) == 1 and name == "DDTDDP"
        else (f"{name}({row + 1},{column + 1})")
    )
    where = f"component {row + 1} of the stress by {by}"
    if name == "DDTDDG":
        where += f" along direction {column + 1}"
    elif name == "DDTDDT":
        where += f" of the {('secondary', 'main')[column]} surface"
    return Finding(
        f"{entry} is {number(float(given[row, column]))}; expected "
        f"{float(value[row, column]):.8g}, the derivative of {where} by differences"
        f"{_also(given, value, allowed, case)}",
        hint=_hint(given, value, allowed, name),
        figures={
            "step": len(case.steps) - 1,
            "point": 0,
            "given": given.tolist(),
            "differences": value.tolist(),
            "error": error.tolist(),
        },
    )


def _fits(given: np.ndarray, value: np.ndarray, allowed: np.ndarray) -> bool:
    return given.shape == value.shape and bool(np.all(np.abs(given - value) <= allowed))


def _also(given: np.ndarray, value: np.ndarray, allowed: np.ndarray, case: Case) -> str:
    """What would fit instead, in words."""
    dt = case.steps[-1].dt
    changes: tuple[tuple[str, Callable[[np.ndarray], np.ndarray]], ...] = (
        (" (with rows and columns exchanged all entries fit)", lambda m: m.T),
        (" (with the opposite sign all entries fit)", lambda m: -m),
        (" (divided by the time increment all entries fit)", lambda m: m / dt),
        (" (times the time increment all entries fit)", lambda m: m * dt),
        (" (half of it fits)", lambda m: 0.5 * m),
        (" (twice of it fits)", lambda m: 2.0 * m),
    )
    if not np.any(given):
        return " (all entries are 0)"
    for words, change in changes:
        if dt > 0 and _fits(change(given), value, allowed):
            return words
    return ""


def _hint(given: np.ndarray, value: np.ndarray, allowed: np.ndarray, name: str) -> str:
    if not np.any(given):
        more = {
            "DDTDDG": ": in slip the direction turns with the motion, and the size changes with "
            "it where the coefficient depends on the slip or its rate (DGAM over DTIME)",
            "DDTDDP": ": in slip it is mu + p dmu/dp along the stress",
        }.get(name, "")
        return f"set {name} wherever LM = 0 is returned{more}"
    if _fits(given.T, value, allowed):
        return f"exchange the indices of {name}: the first is the stress, the second the motion"
    if _fits(-given, value, allowed):
        return f"change the sign of {name}"
    return f"differentiate the stress of this branch again, with all that depends on it ({name})"


def _sliding(subject: Subject) -> Iterator[Case]:
    yield cases.history(subject, [(1.0, 0.4), (0.7, 0.5)])


@rule(
    "tangent.unsymmetric",
    "What a symmetric solver would lose of the tangents.",
    reference="the derivative by the pressure, and that by the slip rate, have no symmetric part",
    severity="note",
    interfaces=("fric",),
    cases=_sliding,
)
def unsymmetric(subject: Subject, case: Case) -> Finding | None:
    """The tangents of a slide."""
    run = run_of(subject, case)
    try:
        for index in range(len(case.steps)):
            run.step(index)
        found = run.driver.symmetry()  # type: ignore[attr-defined]
    except Error as error:
        raise CannotCheck(f"the routine failed: {error}") from error
    if not found.unsymmetric:
        return None
    return Finding(
        found.sentence,
        hint="use the unsymmetric solver (UNSYMM=YES in the step) where friction is large",
        figures={"step": len(case.steps) - 1, "point": 0},
    )
