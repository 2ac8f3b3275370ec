# SPDX-License-Identifier: MIT
"""Stiff and extreme cases: histories of motion and load, a point for each value.

Points with different values run side by side in one driver; what is one number for all points (the
time increment, properties, settings) makes a history of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.study.stability.histories import WAY, History, history_of
from usersub.study.stability.properties import properties
from usersub.study.stability.subjects import Subject

#: Cases in the words of a page.
CASES = {
    "pressure": "pressures from denormal to the largest, zero and negative",
    "pressure path": "pressure through zero, negative, denormal and huge within one history",
    "slip": "slips from denormal to the largest",
    "slip path": "slips of all sizes within one history",
    "step": "time increments from a hundredth to a thousand characteristic times, and far beyond",
    "reversal": "reversal at every increment",
    "hold": "long holds after sliding",
    "temperature": "temperatures out of every table",
    "property": "properties at the ends of their range: zero, tiny, huge, infinite",
    "stiffness": "stiffness in stick 1 to 1e18 times the ordinary",
    "mass": "masses from denormal to 1e300",
    "stick force": "stick forces from zero to infinity",
}


def _sizes(subject: Subject, quick: bool) -> np.ndarray:
    """Factors to the ends of the range."""
    if subject.precision == "single":
        few = [1e-44, 1e-38, 1e-30, 1e-20, 1e-10, 1.0, 1e10, 1e18, 1e30]
        return np.array(few if quick else [*few, 1e-42, 1e-36, 1e-15, 1e-5, 1e5, 1e15, 1e20, 1e34])
    few = [4.94e-324, 1e-310, 1e-300, 1e-160, 1e-80, 1e-30, 1e-12, 1.0, 1e12, 1e30, 1e80, 1e160,
           1e300]  # fmt: skip
    more = [1e-320, 1e-307, 1e-250, 1e-200, 1e-150, 1e-120, 1e-50, 1e-20, 1e-6, 1e-3, 1e3, 1e6,
            1e20, 1e50, 1e120, 1e150, 1e200, 1e250]  # fmt: skip
    return np.array(few if quick else sorted([*few, *more]))


def _largest(subject: Subject) -> float:
    return 1e300 if subject.precision == "double" else 1e36


def _absolute(sizes: np.ndarray, ordinary: float, largest: float) -> np.ndarray:
    """Factors by which `ordinary` becomes the sizes; 1 stays the ordinary."""
    wanted = np.where(sizes == 1.0, ordinary, sizes)
    with np.errstate(under="ignore", over="ignore"):
        return np.minimum(wanted, largest)


def pressures(subject: Subject, quick: bool) -> Iterator[History]:
    """A pressure to each point, constant; and one that goes through everything."""
    sizes = _absolute(_sizes(subject, quick), subject.scales.load, _largest(subject))
    sizes = np.concatenate([sizes, [0.0, -subject.scales.load, -_largest(subject)]])
    history = history_of(subject, "pressure", [f"{p:.3g}" for p in sizes])
    history.load = np.broadcast_to(sizes, history.load.shape).copy()
    yield history
    tiny, huge = float(sizes.min(where=sizes > 0, initial=1.0)), 0.1 * _largest(subject)
    ordinary = subject.scales.load
    path = [ordinary, 0.0, ordinary, -ordinary, ordinary, tiny, huge, ordinary, 0.0, tiny, huge]
    way = [WAY[i % len(WAY)] for i in range(len(path))]
    falling = [1.0, 1.0, 0.5, 0.5, 1e-3, 1e-3, 1.0]
    for word, factor in (("held", 0.0), ("moved on", 1e-3), ("slid on", 1.0)):
        later = [(0.8 * factor, 0.6 * factor)] * (len(falling) - 1)
        history = history_of(subject, "pressure path", [f"falls, {word}"], way=[(0.8, 0.6), *later])
        history.load = subject.scales.load * np.array(falling)[:, np.newaxis]
        yield history
    for word, factor in (("ordinary slip", 1.0), ("slip in stick", 1e-4), ("no slip", 0.0)):
        history = history_of(subject, "pressure path", [word], slip=factor, way=way)
        history.load = np.array(path)[:, np.newaxis]
        yield history


def slips(subject: Subject, quick: bool) -> Iterator[History]:
    """A size of slip to each point, at the time increment that keeps the ordinary rate, if any."""
    sizes = _sizes(subject, quick)
    factors = _absolute(sizes, subject.scales.slip, 0.1 * _largest(subject)) / subject.scales.slip
    yield history_of(
        subject, "slip", [f"{f * subject.scales.slip:.3g}" for f in factors], slip=factors
    )
    order = np.random.default_rng(5).permutation(factors)
    path = np.concatenate([order, order[::-1]])
    way = [WAY[i % len(WAY)] for i in range(len(path))]
    yield history_of(subject, "slip path", ["all sizes"], slip=path[:, np.newaxis], way=way)


def steps(subject: Subject, quick: bool) -> Iterator[History]:
    """Increments by the characteristic time, with a given slip, a given rate, and at rest."""
    factors = [1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e-12, 1e12]
    if not quick:
        factors += [0.03, 0.3, 3.0, 30.0, 300.0, 1e-100, 1e100, 0.0]
    if subject.precision == "single":
        factors = [f for f in factors if f == 0.0 or 1e-20 < f < 1e20]
    for factor in factors:
        values = [
            f"{factor:g} times, {what}" for what in ("same slip", "same rate", "slow", "rest")
        ]
        if not subject.standard and factor == 0.0:
            continue
        capped = min(factor, 1e20 if subject.precision == "double" else 1e10)
        yield history_of(
            subject, "step", values, slip=np.array([1.0, capped, 1e-6 * capped, 0.0]), dt=factor
        )


def reversals(subject: Subject, quick: bool) -> Iterator[History]:
    """Back and forth in every increment, by amplitudes from stick to gross slip."""
    count = 100 if quick else 1000
    factors = np.array([1e-9, 1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0, 1e6])
    way = [(0.8, 0.6), *([(-1.6, -1.2), (1.6, 1.2)] * (count // 2))]
    made = history_of(subject, "reversal", [f"{f:g} slips" for f in factors], slip=factors, way=way)
    made.period = 2
    yield made
    skew = [(1.0, 0.0), *([(-1.0, 1.0), (1.0, -1.0)] * (count // 2))]
    made = history_of(
        subject, "reversal", [f"{f:g} slips, skew" for f in factors[:-1]], slip=factors[:-1],
        way=skew,
    )  # fmt: skip
    made.period = 2
    yield made


def holds(subject: Subject, quick: bool) -> Iterator[History]:
    """At rest after sliding, and after a load in stick."""
    count = 100 if quick else 1000
    factors = np.array([0.0, 1e-6, 1e-3, 1.0, 1e6])
    way = [(0.8, 0.6), *([(0.0, 0.0)] * count), (-0.08, 0.06)]
    for dt in (0.1, 1e3):
        yield history_of(
            subject, "hold", [f"after {f:g} slips, {dt:g} times" for f in factors], slip=factors,
            way=way, dt=dt,
        )  # fmt: skip


def temperatures(subject: Subject, quick: bool) -> Iterator[History]:
    """Temperatures that no table has."""
    if not subject.temperatures:
        return
    most = 1e300 if subject.precision == "double" else 1e36
    values = np.array([-most, -1e6, -273.15, 0.0, 5e-324, 1e6, most])
    yield history_of(subject, "temperature", [f"{t:g}" for t in values], temperature=values)


def stiffness(subject: Subject, quick: bool) -> Iterator[History]:
    """Stiffness in stick, by which enforcement and elastic slip become stiff."""
    ratios = [1.0, 1e6, 1e12, 1e18] if quick else [10.0**k for k in range(0, 19, 2)]
    slope = float(subject.settings.get("stick_slope", 0.0))
    if not subject.standard and not slope:
        return
    factors = np.array([1e-18, 1e-12, 1e-6, 1e-3, 1.0, 1e3])
    for ratio in ratios:
        if slope:
            settings = {**subject.settings, "stick_slope": slope * ratio}
        else:
            settings = {**subject.settings, "elastic_slip_over": 1.0 / ratio}
        other = subject.but(settings=settings)
        yield history_of(
            other, "stiffness", [f"{ratio:g} times, {f:g} slips" for f in factors], slip=factors
        )


def hosts_numbers(subject: Subject, quick: bool) -> Iterator[History]:
    """Explicit: masses and stick forces."""
    if subject.standard:
        return
    sizes = _sizes(subject, True)
    enforcement = subject.settings.get("enforcement")
    if enforcement == "kinematic":
        for factor in (1e-6, 1.0):
            history = history_of(
                subject, "mass", [f"{m:.3g}, {factor:g} slips" for m in sizes], slip=factor
            )
            history.mass = sizes.copy()
            yield history
    elif enforcement != "penalty" and not subject.settings.get("stick_slope"):
        sizes = np.concatenate([[0.0], sizes, [np.inf]])
        history = history_of(subject, "stick force", [f"{s:.3g}" for s in sizes])
        history.stick = sizes.copy()
        yield history


_ALL = (
    pressures, slips, steps, reversals, holds, temperatures, properties, stiffness, hosts_numbers,
)  # fmt: skip


def histories(subject: Subject, quick: bool = False) -> Iterator[History]:
    """All cases of a subject."""
    for make in _ALL:
        yield from make(subject, quick)
