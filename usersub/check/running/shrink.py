# SPDX-License-Identifier: MIT
"""Making a failing case smaller while it fails in the same way.

Changes are tried one after the other, the ones that save most first, until none is accepted or the
time is over. A change is accepted if the judge says the same of the changed case, numbers aside,
and does not say it of a healthy routine there: a rule may rely on what its own cases have in
common, and a case that it was not written for proves nothing.
"""

from __future__ import annotations

import math
import re
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from usersub.check.case import Case, Step
from usersub.check.rule import CannotCheck, Finding, NotApplicable, as_finding
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.rule import Rule
    from usersub.check.subject import Subject

#: Seconds for all of it, and most changes that are tried.
SECONDS, _MOST = 2.0, 400

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|\bnan\b|[-+]?\binf\b")
_PLAIN_STEP = Step((), ())
#: What of a step is set back to what the subject has by default.
_DEFAULTS: dict[str, Any] = {
    name: getattr(_PLAIN_STEP, name)
    for name in (
        "stick", "temperature", "fields", "multiplier", "area", "iterations", "cut_back",
    )
}  # fmt: skip

#: Judges a case: the finding if it fails in the same way, else None.
Judged = Callable[[Case], Finding | None]


def smaller(rule: Rule, subject: Subject, finding: Finding) -> Iterator[Finding]:
    """Findings at smaller and smaller cases, each the same kind as `finding`."""
    if finding.case is None or rule.judge is None:
        return
    healthy = None
    try:
        healthy = healthy_subject(subject)
    except Error:
        return  # nothing would show that a smaller case proves anything
    yield from shrunk(finding, lambda case: _same_kind(rule, subject, healthy, finding, case))


def shrunk(finding: Finding, judged: Judged, seconds: float = SECONDS) -> Iterator[Finding]:
    """Findings at smaller and smaller cases, as long as `judged` gives them."""
    assert finding.case is not None
    end, tried, seen = time.monotonic() + seconds, 0, {finding.case}
    best: Case = finding.case
    while True:
        for candidate in changes(best):
            if candidate in seen:
                continue
            seen.add(candidate)
            tried += 1
            if time.monotonic() > end or tried > _MOST:
                return
            found = judged(candidate)
            if found is not None:
                best = candidate
                yield found
                break
        else:
            return


def kind_of(detail: str) -> str:
    """A sentence without its numbers."""
    return _NUMBER.sub("#", detail)


def _same_kind(
    rule: Rule, subject: Subject, healthy: Subject, finding: Finding, case: Case
) -> Finding | None:
    found = _judged(rule, subject, case)
    if found is None or kind_of(found.detail) != kind_of(finding.detail):
        return None
    return found if _accepts(rule, healthy, case) else None


def _judged(rule: Rule, subject: Subject, case: Case) -> Finding | None:
    assert rule.judge is not None
    try:
        return as_finding(rule.judge(subject, case), case)
    except (NotApplicable, CannotCheck, Error, ValueError, IndexError):
        return None


def _accepts(rule: Rule, healthy: Subject, case: Case) -> bool:
    """Whether a healthy routine passes the rule at a case."""
    assert rule.judge is not None
    try:
        return rule.judge(healthy.but(tell=None), case) is None
    except (NotApplicable, CannotCheck, Error, ValueError, IndexError):
        return False


def healthy_subject(subject: Subject) -> Subject:
    """Coulomb friction behind the interface of the subject, in scenes as the subject has them.

    Raises:
        Error: it cannot be compiled here, or the interface is not there.
    """
    from usersub import laws
    from usersub.errors import MissingTool

    name, precision = subject.interface.name, subject.precision
    try:
        routine = laws.routine("coulomb", name, "c", precision=precision)
    except MissingTool:
        routine = laws.routine("coulomb", name, "python", precision=precision)
    law = laws.law("coulomb")
    states = max(law.state_count(name, props=(0.3,)), subject.states)
    return subject.but(
        routine=routine, interface=routine.interface, name="coulomb", law="coulomb",
        props=(0.3,), states=states, anisotropic=False,
    )  # fmt: skip


# Changes.


def changes(case: Case) -> Iterator[Case]:
    """Simpler cases, the ones that save most first."""
    yield from _fewer_points(case)
    yield from _fewer_steps(case)
    yield from _plain(case)
    yield from _one_direction(case)
    for index, step in enumerate(case.steps):
        for simpler in _simpler_steps(step):
            steps = (*case.steps[:index], simpler, *case.steps[index + 1 :])
            yield case.but(steps=steps)


def _fewer_points(case: Case) -> Iterator[Case]:
    n = case.points
    if n > 1:
        yield from (case.only([k]) for k in range(n))
    if n > 3:
        half = n // 2
        yield case.only(range(half))
        yield case.only(range(half, n))
    if n > 2:
        yield from (case.only([k for k in range(n) if k != gone]) for gone in range(n))


def _fewer_steps(case: Case) -> Iterator[Case]:
    """Without later, earlier or single increments; the one in which points come to touch stays."""
    steps = case.steps
    first = 1 if _still(steps[0]) else 0
    for last in range(first + 1, len(steps)):
        yield case.but(steps=steps[:last])
    for index in range(first, len(steps)):
        if len(steps) - first > 1:
            yield case.but(steps=(*steps[:index], *steps[index + 1 :]))


def _still(step: Step) -> bool:
    return all(c == 0.0 for motion in step.motion for c in motion)


def _plain(case: Case) -> Iterator[Case]:
    if case.order is not None:
        yield case.but(order=None)
        yield case.but(order=tuple(reversed(range(case.points))))
    if case.contact != "node-to-facet":
        yield case.but(contact="node-to-facet")
    if case.props is not None:
        yield case.but(props=None)
    if case.state is not None:
        yield case.but(state=None)
    if case.angle:
        yield case.but(angle=0.0)
        yield from (case.but(angle=a) for a in _rounder(case.angle))


def _one_direction(case: Case) -> Iterator[Case]:
    if case.directions != 2:
        return
    for kept in (0, 1):
        steps = []
        for step in case.steps:
            multiplier = step.multiplier
            motion = tuple((m[kept],) for m in step.motion)
            if multiplier is not None:
                multiplier = tuple((m[kept],) for m in multiplier)
            steps.append(replace(step, motion=motion, multiplier=multiplier))
        yield case.but(steps=tuple(steps))


def _simpler_steps(step: Step) -> Iterator[Step]:
    for name, default in _DEFAULTS.items():
        if getattr(step, name) != default:
            yield replace(step, **{name: default})
    yield from (replace(step, motion=m) for m in _simpler(step.motion, zero=True))
    yield from (replace(step, load=p) for p in _simpler(step.load))
    yield from (replace(step, dt=dt) for dt in _rounder(step.dt))
    for name in ("stick", "temperature", "multiplier", "area"):
        value = getattr(step, name)
        if value is not None:
            for simpler in _simpler(value):
                changed: dict[str, Any] = {name: simpler}
                yield replace(step, **changed)


def _simpler(values: tuple, zero: bool = False) -> Iterator[tuple]:
    """The numbers with one of them zero or rounder."""
    for index, value in enumerate(values):
        if isinstance(value, tuple):
            rounder: Iterator = _simpler(value, zero)
        else:
            rounder = _rounder(value, zero)
        for other in rounder:
            yield (*values[:index], other, *values[index + 1 :])


def _rounder(value: float, zero: bool = False) -> Iterator[float]:
    """Zero, the power of ten below, one digit, two digits; only what is simpler than the value."""
    if not math.isfinite(value) or value == 0.0:
        return
    if zero:
        yield 0.0
    power = math.copysign(float(f"1e{math.floor(math.log10(abs(value)))}"), value)
    candidates: tuple[float, ...] = (power, float(f"{value:.0e}"), float(f"{value:.1e}"))
    if value in candidates[:2]:
        candidates = candidates[: candidates.index(value)]
    yield from dict.fromkeys(c for c in candidates if c != value)
