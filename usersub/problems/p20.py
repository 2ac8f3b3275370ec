# SPDX-License-Identifier: MIT
"""P20: Painleve's rod, one end of which slides on a rough floor: no motion, or two."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.oscillators import Oscillators
from usersub.problems.problem import Outcome, Problem
from usersub.problems.sliding_points import ExplicitPoints, StandardPoints, make_points

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Mass and half length of the uniform rod, gravity.
MASS, HALF, GRAVITY = 1.5, 0.4, 9.81

#: Coefficients below, just beside and above the least one that is bad; tan of the rods' angles.
COEFFICIENTS = (0.3, 1.3, 1.37, 1.6, 2.5)
TANGENTS = (0.2, 0.6, 0.9, 1.3, 1.7, 2.0, 2.4, 3.0, 4.2, 6.0, 9.0)

#: Square of the angular velocity by g/(l sin phi): below one the end is pressed on the floor by its
#: free motion, above one it leaves.
SPINS = (0.0, 0.35, 1.6)

#: Slip of an asked increment; forces are asked in units of the weight.
_SLIP = 1e-3

#: Rest of the normal acceleration, in g, at which a force is a solution.
_REST = {"double": 1e-12, "single": 1e-4}
_TOLERANCES = {"double": 1e-12, "single": 2e-4}

#: The compliant floor: coefficient, tan of the angles, stiffnesses, time by the fastest growth
#: rate, distance from the unstable equilibrium, error times the square of the increments.
COMPLIANT, COMPLIANT_TANGENTS = 1.8, (1.8, 2.0, 2.2)
STIFFNESSES, REACH, APART = (1e6, 1e8), 5.0, 0.005
_COMPLIANT_TOLERANCE = 160.0

_WORDS = ("no solution", "one solution", "two solutions")


def critical(tangent: float | np.ndarray) -> float | np.ndarray:
    """Coefficient above which an angle is bad: (1 + 3 cos^2)/(3 sin cos) = (t^2 + 4)/(3 t)."""
    return (tangent**2 + 4.0) / (3.0 * tangent)


def bad_angles(mu: float) -> tuple[float, float] | None:
    """Between which tan phi is bad; None below the least coefficient, 4/3 at tan phi = 2."""
    root = 9.0 * mu**2 - 16.0
    if root < 0.0:
        return None
    return (3.0 * mu - math.sqrt(root)) / 2.0, (3.0 * mu + math.sqrt(root)) / 2.0


def lift(mu: float, tangent: np.ndarray) -> np.ndarray:
    """Normal acceleration of the sliding end by its force, times the mass."""
    cosine2 = 1.0 / (1.0 + tangent**2)
    return 1.0 + 3.0 * cosine2 - 3.0 * mu * tangent * cosine2


def free(tangent: np.ndarray, spin: np.ndarray) -> np.ndarray:
    """Normal acceleration of the end without contact, in g."""
    return spin - 1.0 + 0.0 * tangent


def solutions(mu: float, tangent: np.ndarray, spin: np.ndarray) -> np.ndarray:
    """How many contact forces there are: force >= 0, acceleration >= 0, one of them zero."""
    b, a = lift(mu, tangent), free(tangent, spin)
    return (a > 0.0).astype(int) + (a * b < 0.0)


class Rods:
    """Rods at different angles, each with its end on a contact point."""

    def __init__(
        self, routine: Routine, mu: float, tangent: np.ndarray, precision: str = "double"
    ) -> None:
        self.cosine, self.sine = 1.0 / np.hypot(1.0, tangent), tangent / np.hypot(1.0, tangent)
        self.points = make_points(routine, [mu], tangent.size, precision)

    def acceleration(self, force: np.ndarray, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Normal acceleration of the ends in g, and its derivative by the force in weights.

        The end goes ahead and the centre follows, so friction turns the end into the floor.
        """
        self.points.begin(1.0)
        answer = self.points.ask(_SLIP, force)
        self.points.end(commit=False)
        turned, slope = (
            1.0 + 3.0 * self.cosine**2 - 3.0 * self.sine * self.cosine * share
            for share in (answer.stress / force, answer.by_pressure)
        )
        return free + turned * force, slope

    def solve(self, free: np.ndarray, rest: float) -> tuple[np.ndarray, np.ndarray]:
        """Number of solutions and the contact force of that in contact, or NaN."""
        one = np.ones_like(free)
        start, slope = self.acceleration(one, free)
        with np.errstate(divide="ignore", invalid="ignore"):
            force = one - start / slope  # Newton: all is linear in the force
        possible = np.isfinite(force) & (force > 0.0)
        left, _ = self.acceleration(np.where(possible, force, 1.0), free)
        held = possible & (np.abs(left) <= rest * (1.0 + force))
        return (free > 0.0).astype(int) + held, np.where(held, force, np.nan)


def _rigid(routine: Routine, precision: str) -> tuple[Rods, dict[str, float], str]:
    """All angles and motions at several coefficients: numbers of solutions, and their forces."""
    tangent, spin = (x.ravel() for x in np.meshgrid(TANGENTS, SPINS))
    a = free(tangent, spin)
    wrong, worst, words = 0, 0.0, []
    for mu in COEFFICIENTS:
        rods = Rods(routine, mu, tangent, precision)
        count, force = rods.solve(a, _REST[precision])
        exact = solutions(mu, tangent, spin)
        wrong += int(np.count_nonzero(count != exact))
        held = ~np.isnan(force)
        with np.errstate(divide="ignore"):
            error = np.abs(force[held] / (-a / lift(mu, tangent))[held] - 1.0)
        worst = max(worst, float(error.max(initial=0.0)))
        words.append(f"mu {mu:g}: {_told(count, tangent, a)}")
    least, angle = _least(routine, precision)
    words.append(f"least mu without a motion {least:.5g} at tan phi = {angle:.3g}")
    errors = {
        "wrong counts": float(wrong),
        "force": worst,
        "least coefficient": abs(0.75 * least - 1.0),
    }
    return rods, errors, "; ".join(words)


def _told(count: np.ndarray, tangent: np.ndarray, free: np.ndarray) -> str:
    """Which numbers of solutions were found, and at which angles."""
    parts: dict[str, list[str]] = {}
    for number in (0, 2):
        where = count == number
        for end, way in (("pressed on", free < 0.0), ("leaving", free > 0.0)):
            if (found := tangent[where & way]).size:
                at = f"at tan phi {found.min():g} to {found.max():g}"
                parts.setdefault(at, []).append(f"{_WORDS[number]} ({end})")
    told = [f"{' or '.join(words)} {at}" for at, words in parts.items()]
    return ", ".join([*told, f"{_WORDS[1]} {'elsewhere' if told else 'everywhere'}"])


def _least(routine: Routine, precision: str) -> tuple[float, float]:
    """The least coefficient at which a rod that is pressed on has no solution, by bisection."""
    tangent = np.linspace(1.5, 2.5, 21)
    low, high, angle = 0.5, 2.5, math.nan
    while (middle := 0.5 * (low + high)) not in (low, high):
        _, slope = Rods(routine, middle, tangent, precision).acceleration(
            np.ones(tangent.size), -np.ones(tangent.size)
        )
        if (slope < 0.0).any():
            high, angle = middle, float(tangent[np.argmin(slope)])
        else:
            low = middle
        if high - low <= _TOLERANCES[precision] * 0.1:
            break
    return high, angle


def _compliant(
    routine: Routine, precision: str, steps: int
) -> tuple[StandardPoints | ExplicitPoints, dict[str, float], str, float]:
    """The same at one instant on a floor of a stiffness: the force over a short time.

    The depth d of the end follows d'' = -a - b k d/m, with b < 0 in the bad region. Rods that are
    pressed on start at d = 0; those that leave start beside the equilibrium that is the second
    solution, one on each side.
    """
    angles = np.array(COMPLIANT_TANGENTS)
    tangent = np.concatenate([[0.6], np.repeat(angles, 3)])
    spin = np.concatenate([[0.0], np.tile([0.35, 1.6, 1.6], angles.size)])
    side = np.concatenate([[0.0], np.tile([0.0, APART, -APART], angles.size)])
    b, a = lift(COMPLIANT, tangent), GRAVITY * free(tangent, spin)
    sine, cosine = tangent / np.hypot(1.0, tangent), 1.0 / np.hypot(1.0, tangent)
    errors, words, length = {}, [], 0.0
    for stiffness in STIFFNESSES:
        k = stiffness / MASS
        rate = np.sqrt(np.abs(b) * k)
        time, rest = REACH / rate[b < 0.0].max(), -a / (b * k)
        start = np.where(side == 0.0, 0.0, rest * (1.0 + side))
        system = Oscillators(
            stiffness=(k * (1.0 + 3.0 * cosine**2))[None, None],
            friction=(-3.0 * sine * cosine / MASS)[None],
            pressure=np.zeros(tangent.size),
            pressure_change=np.full((1, tangent.size), stiffness),
            load=-a[None],
            slip_rate=1.0,
            slip_change=np.zeros((1, tangent.size)),
        )
        points = make_points(routine, [COMPLIANT], tangent.size, precision)
        depth, _ = system.run(points, start[None], np.zeros((1, tangent.size)), time, steps)
        moved = np.where(b > 0.0, np.cos(rate * time), np.cosh(rate * time))
        exact = rest + (start - rest) * moved
        name = f"force at {stiffness:g} N/m"
        errors[name] = float(np.abs(depth[0] / exact - 1.0).max())
        length = max(length, time / steps)
        pressed = (spin < 1.0) & (b < 0.0)
        if (depth[0, pressed] > 0.3 * exact[pressed]).all():
            weights = stiffness * depth[0, pressed].max() / (MASS * GRAVITY)
            words.append(f"{weights:.3g} weights after {1e3 * time:.3g} ms at {stiffness:g} N/m")
    told = "the force stays bounded"
    if len(words) == len(STIFFNESSES):
        told = f"no solution, pressed on: the force runs away ({', '.join(words)}), at once where "
        told += "the floor is rigid; two solutions, leaving: the one in contact is unstable"
    return points, errors, told, length


def run(routine: Routine, law: str, precision: str, method: str, *, steps: int = 400) -> Outcome:
    """One run against the closed form."""
    if method == "rigid":
        rods, errors, says = _rigid(routine, precision)
        points, step, tolerance = rods.points, 1.0, _TOLERANCES[precision]
        what = "number of solutions, force, least coefficient"
    else:
        points, errors, says, step = _compliant(routine, precision, steps)
        what, tolerance = "contact force", _COMPLIANT_TOLERANCE / steps**2
        tolerance = min(0.5, tolerance + (1e-3 if precision == "single" else 0.0))
    count = points.along.shape[1]
    return Outcome(
        problem="P20", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=step, points=count,
        error=float(np.max(list(errors.values()))), error_of=what, tolerance=tolerance,
        details=errors, says=says, **points.watch.times(count),
    )  # fmt: skip


PROBLEM = Problem(
    name="P20",
    title="Painleve's rod: no solution, or two",
    statement="A uniform rod slides with one end on a rough rigid floor, at the angle phi. Where "
    "mu > (1 + 3 cos^2 phi)/(3 sin phi cos phi) friction turns the end into the floor faster than "
    "the contact force lifts it. Pressed on by its free motion the rod then has no contact force "
    "that keeps it out of the floor; leaving it has two. Asked for is their number, in words. On "
    "a floor with a stiffness, the force grows without limit.",
    laws=("coulomb",),
    methods=dict.fromkeys(
        ("fric", "fric_coef", "vfric", "vfriction", "vfric_coef"), ("rigid", "compliant")
    ),
    runner=run,
    options={"steps": "increments on the compliant floor"},
)
