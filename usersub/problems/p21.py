# SPDX-License-Identifier: MIT
"""P21: Klarbring's contact point on coupled springs: where one solution becomes two, or none."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usersub.problems.problem import Outcome, Problem
from usersub.problems.sliding_points import ALLOWABLE, StandardPoints

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficient; force into the plane; mu |W|/K_t.
MU, NORMAL, RATIOS = 0.6, 1.5, (0.5, 0.9, 1.1, 2.0)

#: Loads along the plane, as places between the loads at which something changes: below both,
#: between them, above both.
_LOADS = (0, 1, 2)

#: Places at which forces are compared, on each side, up to the motion at which pressure is gone.
_SAMPLES, _HALVINGS = 40, 90

#: Corrections start so far from the solution; those without DDTDDP are made so often.
_AWAY, _CORRECTIONS = 0.03, 2

#: A slip that costs little pressure at any coupling that is tried.
_SHORT = 1e-3

_TOLERANCE = 1e-12


class Springs(NamedTuple):
    """K_t and W of each point and its load along the plane; mu |W|/K_t.

    K_n, which makes the springs stable, counts for nothing as long as the point is on the plane.
    """

    along: np.ndarray
    coupling: np.ndarray
    load: np.ndarray
    ratio: np.ndarray


class Exact(NamedTuple):
    """The solutions in contact, NaN where there is none, and whether the point may lift off."""

    stick: np.ndarray
    slip: np.ndarray
    lifts: np.ndarray

    @property
    def count(self) -> np.ndarray:
        """Solutions in contact."""
        return np.isfinite(self.stick).astype(int) + np.isfinite(self.slip)


def springs() -> Springs:
    """A point for each ratio, load and sign of the coupling, no two equally stiff."""
    ratio, place, sign = (
        x.ravel() for x in np.meshgrid(RATIOS, _LOADS, (-1.0, 1.0), indexing="ij")
    )
    along = 2.0 + 0.1 * np.arange(ratio.size)
    coupling = sign * ratio * along / MU
    # Slip begins at mu f_n, contact ends at K_t f_n/|W|; the smaller one of the two is the first.
    ends = np.sort([np.ones_like(ratio), 1.0 / ratio], axis=0) * MU * NORMAL
    load = np.choose(place, [0.6 * ends[0], 0.5 * (ends[0] + ends[1]), 1.3 * ends[1]])
    return Springs(along, coupling, sign * load, ratio)


def exact(given: Springs, elastic: float) -> Exact:
    """Closed form; with K_t u + tau = f_t, p = f_n - W u, |tau| <= mu p.

    Args:
        elastic: allowable elastic slip, 0 for none.
    """
    side = np.sign(given.coupling)  # the loads have the sign of the coupling
    slip = (given.load - side * MU * NORMAL) / (given.along - MU * np.abs(given.coupling))
    pressed = NORMAL - given.coupling * slip > 0.0
    slip = np.where((side * slip > elastic) & pressed, slip, np.nan)
    stick = np.where(np.abs(given.load) <= MU * NORMAL, 0.0, np.nan)
    if elastic:
        # tau = (mu p/elastic) u: the smaller root.
        b, a = given.along + MU * NORMAL / elastic, MU * given.coupling / elastic
        stick += 2.0 * given.load / (b + np.sqrt(b**2 - 4.0 * a * given.load))
    return Exact(stick, slip, given.along * NORMAL < given.coupling * given.load)


class Contact:
    """The points in contact, with the pressure that their motion leaves."""

    def __init__(self, routine: Routine, given: Springs, lagrange: bool) -> None:
        self.given, self.lagrange, self.size = given, lagrange, given.load.size
        self.points = StandardPoints(routine, [MU], self.size, lagrange=lagrange)

    def begin(self, multiplier: np.ndarray | float) -> None:
        """Opens an increment, which is cut back; one with multipliers that large has slipped."""
        self.points.begin(1.0)
        if self.lagrange:
            self.points.multiplier[...] = multiplier * self.points.along
            self.points.ask(0.0, NORMAL)

    def end(self) -> None:
        """Forgets the increment."""
        self.points.end(commit=False)

    def unbalanced(self, motion: np.ndarray, coupling: np.ndarray | None = None) -> np.ndarray:
        """K_t u + tau - f_t with the pressure of the motion."""
        given = self.given
        pressure = NORMAL - (given.coupling if coupling is None else coupling) * motion
        self.answer = self.points.ask(motion, pressure)
        return given.along * motion + self.answer.stress - given.load

    def sticking(self) -> np.ndarray:
        """With multipliers: where a point that carries the load does not move; NaN elsewhere."""
        self.begin(self.given.load)
        rest = np.abs(self.unbalanced(np.zeros(self.size)))
        held = (self.points.driver.array("lm") == 1) & (rest <= 1e-12 * NORMAL)
        self.end()
        return np.where(held, 0.0, np.nan)

    def slipping(self) -> list[np.ndarray]:
        """Motions of all balanced states between the ends of the samples, NaN where fewer.

        The force out of balance changes its sign there; each change is bisected.
        """
        reach = 0.999 * NORMAL / np.abs(self.given.coupling)
        share = np.geomspace(1e-3 * ALLOWABLE, 1.0, _SAMPLES)
        if self.lagrange:
            ways = [(1.0, share), (-1.0, share)]
        else:
            ways = [(1.0, np.concatenate([-share[::-1], share]))]
        found: list[np.ndarray] = []
        for way, shares in ways:
            self.begin(way * 10.0 * NORMAL)
            places = way * shares[:, None] * reach
            signs = np.array([np.sign(self.unbalanced(u)) for u in places])
            changes = signs[1:] * signs[:-1] <= 0.0
            for nth in range(1, int(changes.sum(0).max(initial=0)) + 1):
                here = (np.cumsum(changes, axis=0) == nth) & changes
                at = here.argmax(axis=0)
                column = np.arange(self.size)
                root = self._bisect(places[at, column], places[at + 1, column])
                found.append(np.where(here.any(axis=0), root, np.nan))
            self.end()
        return found

    def _bisect(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        below = np.sign(self.unbalanced(low))
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            same = np.sign(self.unbalanced(middle)) == below
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return 0.5 * (low + high)

    def determinant(self, coupling: np.ndarray, *, full: bool) -> np.ndarray:
        """Of [[K_t + DDTDDG, DDTDDP], [W, 1]], the tangent in motion and pressure, in slip; over
        K_t. Without DDTDDP unless `full`."""
        sign = np.sign(coupling)
        self.unbalanced(sign * _SHORT, coupling)
        by_pressure = self.answer.by_pressure if full else 0.0
        whole = self.given.along + self.answer.by_slip - coupling * by_pressure
        return whole / self.given.along

    def limit(self, *, full: bool) -> np.ndarray:
        """|W| at which the determinant is no longer positive; infinite where it always is."""
        side = np.sign(self.given.coupling)
        low, high = np.zeros(self.size), 50.0 * self.given.along
        self.begin(side * 10.0 * NORMAL)
        never = self.determinant(side * high, full=full) > 0.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            good = self.determinant(side * middle, full=full) > 0.0
            low, high = np.where(good, middle, low), np.where(good, high, middle)
        self.end()
        return np.where(never, np.inf, high)

    def factor(self, slip: np.ndarray, *, full: bool) -> np.ndarray:
        """By which the error of the motion changes in a correction from beside `slip`."""
        given = self.given
        start = np.where(np.isfinite(slip), slip, np.sign(given.coupling)) * (1.0 + _AWAY)
        self.begin(np.sign(given.coupling) * 10.0 * NORMAL)
        motion, count = start, 1 if full else _CORRECTIONS
        for _ in range(count):
            residual = self.unbalanced(motion)
            whole = given.along + self.answer.by_slip
            if full:
                whole = whole - given.coupling * self.answer.by_pressure
            motion = motion - residual / whole
        self.end()
        return (np.abs(motion - slip) / np.abs(start - slip)) ** (1.0 / count)


def _found(contact: Contact) -> tuple[np.ndarray, Exact]:
    """The number of solutions in contact that there are, and the solutions."""
    roots = contact.slipping()
    if contact.lagrange:
        roots.append(contact.sticking())
    given, count = contact.given, np.zeros(contact.size, int)
    stick, slip = np.full(contact.size, np.nan), np.full(contact.size, np.nan)
    for root in roots:
        there = np.isfinite(root)
        count += there
        short = there & (np.abs(root) <= ALLOWABLE)
        stick, slip = np.where(short, root, stick), np.where(there & ~short, root, slip)
    # Away from the plane nothing but the springs decides.
    gap = (given.coupling * given.load - given.along * NORMAL) / given.along
    return count, Exact(stick, slip, gap > 0.0)


def _errors(contact: Contact, found: Exact, count: np.ndarray, truth: Exact) -> dict[str, float]:
    """Compares the solutions, the limit and the corrections."""
    wrong, worst, given = int(np.count_nonzero(count != truth.count)), 0.0, contact.given
    for ours, expected in ((found.stick, truth.stick), (found.slip, truth.slip)):
        both = np.isfinite(ours) & np.isfinite(expected)
        wrong += int(np.count_nonzero(np.isfinite(ours) != np.isfinite(expected)))
        size = np.where(expected == 0.0, 1.0, np.abs(expected))[both]
        worst = max(worst, float((np.abs(ours - expected)[both] / size).max(initial=0.0)))
    limit = contact.limit(full=True) * MU / given.along
    slips_there = np.isfinite(truth.slip)
    linear = contact.factor(truth.slip, full=False)[slips_there] / given.ratio[slips_there]
    quadratic = contact.factor(truth.slip, full=True)[slips_there]
    return {
        "wrong counts": float(wrong),
        "solutions": worst,
        "limit": float(np.abs(limit - 1.0).max()),
        "factor without DDTDDP": float(np.abs(linear - 1.0).max()),
        "one correction": float(quadratic.max()) * _AWAY,
    }


def _told(given: Springs, found: Exact, limit: float) -> str:
    """Which solutions each ratio has, at loads from small to large."""
    parts = []
    for ratio in RATIOS:
        loads = []
        for i in np.flatnonzero(given.ratio == ratio):
            ways = [
                name
                for name, there in (
                    ("stick", np.isfinite(found.stick[i])), ("slip", np.isfinite(found.slip[i])),
                )
                if there
            ]  # fmt: skip
            loads.append((*ways, *(["lift-off"] if found.lifts[i] else [])))
        kinds = list(dict.fromkeys(loads))
        if all(len(kind) == 1 for kind in kinds) and ("slip",) in kinds:
            told = f"one solution ({', '.join(kind[0] for kind in kinds)})"
        else:
            told = "; ".join(map(_words, kinds))
        parts.append(f"mu|W| = {ratio:g} K_t: {told}")
    when = "is never singular" if math.isinf(limit) else f"is singular at mu|W| = {limit:.3g} K_t"
    return ". ".join([*parts, f"Without DDTDDP the tangent {when}"])


def _words(kind: tuple[str, ...]) -> str:
    """The solutions of one load."""
    contact = [name for name in kind if name != "lift-off"]
    if len(contact) == 2:
        told = f"two solutions in contact ({' and '.join(contact)})"
    else:
        told = f"one solution ({contact[0]})" if contact else "no solution in contact"
    if "lift-off" in kind:
        told += " besides lift-off" if contact else ", only lift-off"
    return told


def run(routine: Routine, law: str, precision: str, method: str) -> Outcome:
    """One run against the closed form."""
    given, lagrange = springs(), method == "lagrange"
    contact = Contact(routine, given, lagrange)
    truth = exact(given, 0.0 if lagrange else ALLOWABLE)
    with np.errstate(divide="ignore", invalid="ignore"):
        count, found = _found(contact)
        errors = _errors(contact, found, count, truth)
        blind = float((contact.limit(full=False) * MU / given.along).min())
    return Outcome(
        problem="P21", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=1.0, points=contact.size,
        error=float(np.max(list(errors.values()))),
        error_of="solutions, limit of uniqueness, convergence", tolerance=_TOLERANCE,
        details={**errors, "limit without DDTDDP": blind},
        says=_told(given, found, blind), **contact.points.watch.times(contact.size),
    )  # fmt: skip


PROBLEM = Problem(
    name="P21",
    title="Contact point on coupled springs: two solutions, or none",
    statement="A point on springs K = [[K_t, W], [W, K_n]] is pressed on a rigid plane and pulled "
    "along it. Motion along the plane changes the pressure by W, and with it friction. Up to "
    "mu |W| = K_t there is one solution for any load; beyond it, some loads have two in contact, "
    "stick and slip, and others none. A tangent without the derivative of stress by pressure does "
    "not know of the limit.",
    laws=("coulomb",),
    methods={"fric": ("penalty",), "fric_coef": ("penalty", "lagrange")},
    runner=run,
)
