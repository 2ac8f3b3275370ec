# SPDX-License-Identifier: MIT
"""From what came of a history to verdicts."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from usersub.driver.status import VALUES
from usersub.errors import Error
from usersub.study.stability.cell import Cell
from usersub.study.stability.running import Trace

#: Units in the last place by which a force may exceed its bound.
ULPS = 4.0
#: Energy that rounding may create, in units in the last place of the work done, per increment.
_WORK_ULPS = 32.0

#: A number in a message, "= nan" or "(fCoef nan, ..."; the word of a sentence is "NaN".
_NAN = re.compile(r"(?<![\w.])-?nan\b")
_OVERFLOW = re.compile(r"returned (?:TAU|fTangential)[^=]*= -?inf\b|pressure overflows")
#: A coefficient is not bounded by a stick force, only by its law.
_COEFFICIENT = re.compile(r"returned fCoef[^=]*= -?inf\b|fCoef [^,]*\binf\b")


def judge(trace: Trace) -> Iterator[Cell]:
    """A cell for each point."""
    history, subject = trace.history, trace.history.subject
    steps = len(history.dt)
    for point, value in enumerate(history.values):
        if history.refused:
            verdict, reason, count = "refused", history.refused, 0
        elif point in trace.refused:
            count, error = trace.refused[point]
            verdict, reason = refusal(
                error,
                history.valid and _is_bounded(trace, point),
                history.valid and _has_law_bound(trace, point),
            )
            if history.valid and _NAN.search(reason):
                verdict, reason = "fails", f"NaN from finite input: {reason}"
        else:
            count, (verdict, reason) = steps, ("stable", "")
        fault = "" if history.refused else _fault(trace, point)
        if verdict == "stable" and not fault:
            verdict, reason = _growth(trace, point)
        if fault:
            verdict, reason = "fails", fault
        yield Cell(
            history.case, value, subject.name, subject.interface, subject.language,
            subject.precision, verdict, reason, count * history.repeats,
        )  # fmt: skip


def refusal(error: Error, bounded: bool, by_law: bool) -> tuple[str, str]:
    """Whether a refusal is in order: a crash, an endless loop, an overflow before the bound is not.

    Args:
        bounded: whether the friction has a finite bound.
        by_law: whether the law itself has one, and so its coefficient.
    """
    words = str(error)
    if (bounded and _OVERFLOW.search(words)) or (by_law and _COEFFICIENT.search(words)):
        return "fails", f"overflow before the bound: {words}"
    if error.status == VALUES["ROUTINE_CRASHED"]:
        return "fails", words
    return "refused", words


def _is_bounded(trace: Trace, point: int) -> bool:
    """Whether the friction of the refused increment has a finite bound."""
    history = trace.history
    if not history.subject.standard and _has_stick_bound(trace) and not history.subject.settings:
        return history.stick is None or bool(np.isfinite(history.stick[point]))
    return _has_law_bound(trace, point)


def _has_law_bound(trace: Trace, point: int) -> bool:
    """Whether the law bounds the friction of the refused increment."""
    step, _ = trace.refused[point]
    if step >= len(trace.history.dt) or trace.history.subject.bound is None:
        return False
    return bool(np.isfinite(_law_bounds(trace, point)[step]))


def _fault(trace: Trace, point: int) -> str:
    """What must never be, in words; "" if there is nothing."""
    friction = trace.friction[:, :, point]
    done = ~np.isnan(friction[:, 0])
    if point not in trace.refused and not np.all(np.isfinite(friction)):
        return f"friction is {friction[~np.isfinite(friction)][0]} in an increment that succeeded"
    return _beyond(trace, point, done) or _created(trace, point, done)


def _beyond(trace: Trace, point: int, done: np.ndarray) -> str:
    """A force outside its bound."""
    subject = trace.history.subject
    eps = float(np.finfo(np.float64 if subject.precision == "double" else np.float32).eps)
    least = 5e-324 if subject.precision == "double" else 1.4e-45
    size = np.hypot(*trace.friction[:, :, point].T)
    bounds = []
    if subject.bound is not None:
        own = _law_bounds(trace, point)
        bounds.append(("the law's bound", own if subject.follows else np.maximum.accumulate(own)))
    if trace.stick is not None and _has_stick_bound(trace):
        bounds.append(("the stick force", trace.stick[:, point]))
    for what, bound in bounds:
        with np.errstate(over="ignore", invalid="ignore"):
            above = np.flatnonzero(done & (size > bound * (1.0 + ULPS * eps) + ULPS * least))
        if above.size:
            i = above[0]
            return (
                f"friction {size[i]:.17g} in increment {i + 1}, more than {what}, {bound[i]:.17g}"
            )
    return ""


def _law_bounds(trace: Trace, point: int) -> np.ndarray:
    """The law's bound in each increment, of the pressure of this increment."""
    subject = trace.history.subject
    assert subject.bound is not None
    loads = trace.history.load[:, point].tolist()
    known = {load: subject.bound(_as(load, subject.precision)) for load in set(loads)}
    found = np.array([known[load] for load in loads], float)
    return np.where(np.isfinite(found), found, np.inf)


def _growth(trace: Trace, point: int) -> tuple[str, str]:
    """What grows within bounds, as the law says itself."""
    subject = trace.history.subject
    if subject.bound is None or subject.follows:
        return "stable", ""
    bound, size = _law_bounds(trace, point), np.hypot(*trace.friction[:, :, point].T)
    above = (bound > 0) & (bound < size)
    worst = float(np.max(size[above] / bound[above], initial=1.0))
    if worst < 1.0 + 1e-6:
        return "stable", ""
    return (
        "bounded",
        f"up to {worst:.3g} times what the pressure of now carries, never above what an earlier "
        "one carried: by its equations the bristle follows a falling pressure only as it moves",
    )


def _as(load: float, precision: str) -> float:
    with np.errstate(over="ignore", under="ignore"):
        return float(np.float32(load)) if precision == "single" else load


def _has_stick_bound(trace: Trace) -> bool:
    """Laws with a stiffness of their own stand for their stick themselves."""
    from usersub import laws

    law = trace.history.subject.law
    return not law or laws.law(law).kind not in ("bristle",)


def _created(trace: Trace, point: int, done: np.ndarray) -> str:
    """Energy that came out of a contact under constant pressure, more than ever went in; or out of
    the second half of a cyclic history, where nothing is left of the beginning to be given back."""
    history, subject = trace.history, trace.history.subject
    loads = history.load[done, point]
    if not subject.closed or loads.size == 0 or np.any(loads != loads[0]) or loads[0] <= 0:
        return ""
    eps = float(np.finfo(np.float64 if subject.precision == "double" else np.float32).eps)
    with np.errstate(all="ignore"):
        motion = history.motion[done, :, point]
        friction = trace.friction[done, :, point]
        scale = (np.abs(motion).max() or 1.0), (np.abs(friction).max() or 1.0)
        work = np.sum((motion / scale[0]) * (friction / scale[1]), axis=1)
        sizes = np.hypot(*(motion / scale[0]).T) * np.hypot(*(friction / scale[1]).T)
        total, allowed = np.cumsum(work), _WORK_ULPS * eps * np.cumsum(sizes)
        if history.period and len(work) > 4 * history.period:
            cycles = len(work) // (2 * history.period)
            late = slice(len(work) - cycles * history.period, len(work))
            made = float(np.sum(work[late]))
            if made < -_WORK_ULPS * eps * float(np.sum(sizes[late])):
                return f"energy is created: work {made:.3g} in the last {cycles} cycles"
    worst = np.flatnonzero(total < -allowed)
    if worst.size:
        i = worst[0]
        done_in_all = float(np.sum(sizes[: i + 1]))
        return f"energy is created: work {total[i]:.3g} of {done_in_all:.3g} by increment {i + 1}"
    return ""
