# SPDX-License-Identifier: MIT
"""P22: two degrees of freedom of a mass on a moving belt: friction couples its modes to flutter."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usersub.problems.oscillators import Oscillators
from usersub.problems.problem import Outcome, Problem
from usersub.problems.sliding_points import ExplicitPoints, StandardPoints, make_points

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficient, stiffness of contact by mass, preload by mass, speed of the belt, damping d.
MU, CONTACT, PRELOAD, SPEED, DAMPING = 0.4, 1.0, 1.0, 10.0, 0.01

#: Stiffness across, the one of contact included, k22; k12 and k11 - k22, both over mu k_n. The
#: first four flutter; friction does not reach the last two at any k11.
ACROSS = 2.0
COUPLING = (0.5, 0.3, 0.6, 0.45, 0.5, 0.4, 1.3, -0.5)
DETUNING = (0.0, 0.3, -0.6, 0.9, 1.1, -1.5, 0.1, 0.2)

#: Time of the motion; largest pressure at its start, beyond the preload.
TIME, AMPLITUDE = 30.0, 0.04

#: Error of the motion times the square of the increments; single precision adds rounding.
_TOLERANCES = {"modes": 1e-12, "midpoint": 9e3, "central differences": 9e3}
_SINGLE = 2e-3

_HALVINGS = 60


class Exact(NamedTuple):
    """Eigenvalues of the stiffness with friction, and growth rate of the motion."""

    squares: np.ndarray  # (2, points), complex
    growth: np.ndarray


def system(points: int) -> Oscillators:
    """The masses: x along the belt, y into it; friction pulls them along."""
    scale = MU * CONTACT
    k12 = scale * np.resize(COUPLING, points)
    k11 = ACROSS + scale * np.resize(DETUNING, points)
    k22 = np.full(points, ACROSS)
    zero, one = np.zeros(points), np.ones(points)
    return Oscillators(
        stiffness=np.array([[k11, k12], [k12, k22]]),
        friction=np.array([-one, zero]),
        pressure=PRELOAD * one,
        pressure_change=np.array([zero, CONTACT * one]),
        load=np.array([zero, zero]),
        slip_rate=SPEED,
        slip_change=np.array([-one, zero]),
        damping=DAMPING,
    )


def discriminant(stiffness: np.ndarray, mu: float = MU) -> np.ndarray:
    """(k11 - k22)^2 + 4 k12 (k12 - mu k_n); flutter below zero."""
    k12 = stiffness[0, 1]
    return (stiffness[0, 0] - stiffness[1, 1]) ** 2 + 4.0 * k12 * (k12 - mu * CONTACT)


def critical(k12: np.ndarray, mu: float = MU) -> np.ndarray:
    """|k11 - k22| below which there is flutter; NaN where there is none."""
    with np.errstate(invalid="ignore"):
        return np.sqrt(4.0 * k12 * (mu * CONTACT - k12))


def exact(stiffness: np.ndarray) -> Exact:
    """The closed form."""
    mean = 0.5 * (stiffness[0, 0] + stiffness[1, 1])
    half = 0.5 * np.sqrt(discriminant(stiffness) + 0j)
    squares = np.array([mean + half, mean - half])
    return Exact(squares, -DAMPING + np.sqrt(DAMPING**2 - squares).real.max(axis=0))


def motion(stiffness: np.ndarray, place: np.ndarray, time: float) -> tuple[np.ndarray, np.ndarray]:
    """Exact place and velocity after `time` from rest at `place`, by Sylvester's formula."""
    whole = stiffness.astype(complex)
    whole[0, 1] -= MU * CONTACT
    first, second = exact(stiffness).squares

    def function(values: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """f(K) times the place, by the values f(first), f(second)."""
        with_k = np.einsum("ijk,jk->ik", whole, place)
        one, two = values
        return (one * (with_k - second * place) - two * (with_k - first * place)) / (first - second)

    waves = [np.sqrt(DAMPING**2 - square) for square in (first, second)]
    fade = np.exp(-DAMPING * time)
    sines = [fade * np.sinh(s * time) / s for s in waves]
    cosines = [fade * np.cosh(s * time) + DAMPING * i for s, i in zip(waves, sines, strict=True)]
    speeds = [-square * i for square, i in zip((first, second), sines, strict=True)]
    return function(tuple(cosines)).real, function(tuple(speeds)).real


def amplitude(stiffness: np.ndarray, place: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """Share of the motion that grows fastest, or fades slowest: it goes as exp(growth time)."""
    square = exact(stiffness).squares[0]
    wave = np.sqrt(DAMPING**2 - square)
    wave = np.where(wave.real < 0.0, -wave, wave)
    # The left eigenvector of the stiffness makes one equation of the two.
    left = np.array([stiffness[1, 0] + 0j, square - stiffness[0, 0]])
    mode, rate = (left * place).sum(0), (left * velocity).sum(0)
    return np.abs((rate + (DAMPING + wave) * mode) / (2.0 * wave))


def flutters(matrix: np.ndarray) -> np.ndarray:
    """Which of the 2 x 2 matrices (2, 2, points) have a conjugate pair of eigenvalues."""
    values = np.linalg.eigvals(np.moveaxis(matrix, -1, 0))
    return np.asarray(values.imag != 0.0).any(axis=1)


def _symmetric(matrix: np.ndarray) -> np.ndarray:
    return 0.5 * (matrix + matrix.swapaxes(0, 1))


def _modes(masses: Oscillators, points: StandardPoints) -> tuple[dict[str, float], str]:
    """Eigenvalues of the system with the driver's tangents, and what the symmetric part says."""
    points.begin(1e-3)
    answer = points.ask(SPEED * 1e-3, masses.pressure)
    points.end(commit=False)
    truth, stiffness = exact(masses.stiffness), masses.stiffness
    matrix = masses.tangent(answer)
    squares = np.linalg.eigvals(np.moveaxis(matrix, -1, 0)).astype(complex)
    growth = -DAMPING + np.sqrt(DAMPING**2 - squares).real.max(axis=1)
    found, expected = flutters(matrix), discriminant(stiffness) < 0.0
    unsure = ~np.isnan(critical(stiffness[0, 1]))
    limit = _critical(matrix[:, :, unsure])
    missed = int(np.count_nonzero(expected & ~flutters(_symmetric(matrix))))
    without = flutters(masses.tangent(answer._replace(by_pressure=0.0 * answer.by_pressure)))
    errors = {
        "wrong points": float(np.count_nonzero(found != expected)),
        "growth": float(np.abs(growth / truth.growth - 1.0).max()),
        "limit": float(np.abs(limit / critical(stiffness[0, 1, unsure]) - 1.0).max()),
    }
    details = {
        **errors,
        "flutter": float(np.count_nonzero(found)),
        "flutter by the symmetric part": float(expected.sum() - missed),
        "flutter without DDTDDP": float(np.count_nonzero(without)),
        "symmetric misses": float(missed),
    }
    return details, _told(found, growth, missed, int(np.count_nonzero(expected)))


def _critical(matrix: np.ndarray) -> np.ndarray:
    """|k11 - k22| at which the eigenvalues become real, by bisection of k11."""
    low, high = np.zeros(matrix.shape[2]), np.full(matrix.shape[2], 10.0 * MU * CONTACT)
    changed = matrix.copy()
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        changed[0, 0] = changed[1, 1] + middle
        pair = flutters(changed)
        low, high = np.where(pair, middle, low), np.where(pair, high, middle)
    return high


def _told(found: np.ndarray, growth: np.ndarray, missed: int, expected: int) -> str:
    words = f"flutter of {np.count_nonzero(found)} of {found.size} masses"
    if found.any():
        words += f", growing by up to {growth.max():.3g} 1/s"
    return f"{words}; the symmetric part of the tangent misses {missed} of {expected}"


def _moved(
    masses: Oscillators, points: StandardPoints | ExplicitPoints, steps: int
) -> tuple[dict[str, float], str]:
    """The motion from beside equilibrium, in time: which masses grow, and how."""
    count = masses.pressure.size
    # Friction of the preload is carried at rest, at the place 0.
    points.begin(1e-3)
    held = points.ask(SPEED * 1e-3, masses.pressure).stress
    points.end(commit=False)
    masses.load = masses.friction * held
    place = AMPLITUDE * np.array([np.sin(1.0 + np.arange(count)), np.ones(count)])
    u, v = masses.run(points, place, np.zeros_like(place), TIME, steps)
    at, speed = motion(masses.stiffness, place, TIME)
    size = np.sqrt((at**2 + speed**2).sum(0))
    errors = {"motion": float((np.sqrt(((u - at) ** 2 + (v - speed) ** 2).sum(0)) / size).max())}
    truth = exact(masses.stiffness).growth
    share = amplitude(masses.stiffness, u, v) / amplitude(masses.stiffness, place, 0.0 * place)
    growth = np.log(share) / TIME
    errors["growth"] = float(np.abs(growth / truth - 1.0).max())
    errors["wrong points"] = float(np.count_nonzero((growth > 0.0) != (truth > 0.0)))
    parts = []
    for verb, way in (("grow", growth > 0.0), ("fade", growth <= 0.0)):
        if way.any():
            ends = (f"{rate(np.abs(growth[way])):.3g}" for rate in (np.min, np.max))
            rates = " to ".join(dict.fromkeys(ends))
            parts.append(f"{np.count_nonzero(way)} of {count} masses {verb} by {rates} 1/s")
    return errors, ", ".join(parts)


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = len(COUPLING),
    steps: int = 1200,
) -> Outcome:
    """One run against the closed form."""
    masses, contact = system(points), make_points(routine, [MU], points, precision)
    tolerance = _TOLERANCES[method]
    if method == "modes":
        assert isinstance(contact, StandardPoints)
        details, says = _modes(masses, contact)
        errors = {name: details[name] for name in ("wrong points", "growth", "limit")}
        what = "growth rate, limit of flutter"
    else:
        errors, says = _moved(masses, contact, steps)
        details, what = errors, f"motion after {TIME:g} s"
        tolerance = tolerance / steps**2 + (_SINGLE if precision == "single" else 0.0)
        tolerance = min(tolerance, 0.5)  # no point may be wrong, however few the increments
    return Outcome(
        problem="P22", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=TIME / steps, points=points,
        error=float(np.max(list(errors.values()))), error_of=what, tolerance=tolerance,
        details=details, says=says, **contact.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P22",
    title="Mode coupling of a mass on a belt",
    statement="Masses on springs k11, k12, k22 lie on a moving belt, with the stiffness k_n of "
    "contact in k22 and a constant coefficient. Friction follows the pressure, so the stiffness "
    "is not symmetric; where (k11 - k22)^2 + 4 k12 (k12 - mu k_n) < 0 it flutters, whatever the "
    "speed. Friction does not depend on the slip: all of it comes from the derivative of stress "
    "by pressure.",
    laws=("coulomb",),
    methods={
        **dict.fromkeys(("fric", "fric_coef"), ("modes", "midpoint")),
        **dict.fromkeys(("vfric", "vfriction", "vfric_coef"), ("central differences",)),
    },
    runner=run,
    options={"points": "masses", "steps": "increments of the motion"},
)
