# SPDX-License-Identifier: MIT
"""P19: a particle that slides obliquely where friction has a coefficient for each direction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import fixed
from usersub.problems.choose import positive
from usersub.problems.problem import Outcome, Problem, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficients, gravity, initial speed, time; initial angles between velocity and direction 1. The
#: first particle is the one of the statement.
MU, GRAVITY, SPEED, TIME, ANGLE = (0.1, 0.4), 9.81, 1.0, 0.2, 1.0
_SPREAD = 0.35

#: Allowable elastic slip: nothing against the motion of an increment.
ALLOWABLE = 1e-12

#: Relative error times the square of the increments; the ellipse turns a particle further.
TOLERANCES = {"orthotropic": 0.1, "anisotropic": 2.5}

_NEWTON_LIMIT, _NEWTON_ACCURACY = 20, 1e-13


def angles(points: int) -> np.ndarray:
    """Initial angles of the particles."""
    return ANGLE - _SPREAD * np.arange(points) / points


class Exact:
    """The closed form of a law: speed by angle, and the angle by quadrature of the time.

    Of the statement's law the friction is p diag(mu1, mu2) v/|v|, of `anisotropic` (slip normal to
    an ellipse, M = diag(mu1, mu2)) p M^2 v/|M v|. In both, the components of the velocity fall
    with powers of each other, the powers being those of mu1 and mu2, or of their squares.
    """

    def __init__(self, law: str) -> None:
        power = 2 if law == "anisotropic" else 1
        self.first, self.second = (m**power for m in MU)
        self.ellipse = power == 2

    def speed(self, angle: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Speed when the velocity has turned from `start` to `angle`."""
        part = self.first / (self.second - self.first)
        return (
            SPEED
            * (np.sin(angle) / np.sin(start)) ** part
            * (np.cos(start) / np.cos(angle)) ** (1.0 + part)
        )

    def _rate(self, angle: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Time by angle."""
        sine, cosine = np.sin(angle), np.cos(angle)
        width = np.hypot(MU[0] * cosine, MU[1] * sine) if self.ellipse else 1.0
        turning = GRAVITY * (self.first - self.second) * sine * cosine
        return self.speed(angle, start) * width / turning

    def angle(self, start: np.ndarray, time: float = TIME) -> np.ndarray:
        """Angles after `time`: Newton on the 40-point Gauss quadrature, which reaches rounding."""
        nodes, weights = np.polynomial.legendre.leggauss(40)
        angle = 0.9 * start
        for _ in range(50):
            half = 0.5 * (angle - start)
            at = start + half * (1.0 + nodes[:, None])
            passed = half * (weights @ self._rate(at, start))
            change = (time - passed) / self._rate(angle, start)
            angle = np.clip(angle + change, 0.01 * start, start)
            if np.abs(change).max() <= 1e-15:
                break
        return angle


class Particles:
    """Particles of unit mass in an implicit host: the implicit midpoint rule."""

    def __init__(
        self, routine: Routine, law: str, points: int, lagrange: bool, allowable: float = ALLOWABLE
    ) -> None:
        from usersub import Scene, StandardDriver

        fric = routine.interface.name == "fric"
        scene = Scene(
            points=points, dimension=3, characteristic_length=allowable / 5e-3,
            props=list(MU) + ([] if law == "anisotropic" else [allowable]),
            states=2 if fric else 0, anisotropic=0 if fric else 1,
            enforcement="lagrange" if lagrange else "default",
        )  # fmt: skip
        self.driver = StandardDriver(routine, scene, reuse=True)
        self.slip = np.zeros((2, points), order="F")
        self.multiplier = np.zeros((2, points), order="F")
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        self.driver.bind(slip_increment=self.slip, multiplier=self.multiplier,
                         pressure=np.full(points, GRAVITY), **extra)  # fmt: skip
        self.driver.begin_increment(1.0)  # closes the contact: no friction yet
        fixed.iterate(self.driver)
        self.driver.commit()
        self.iterations = 0
        self.watch = Stopwatch()

    def increment(self, velocity: np.ndarray, dt: float) -> np.ndarray:
        """The velocity at the end of an increment; NaN if Newton fails."""
        motion = dt * velocity
        self.driver.begin_increment(dt)
        for _ in range(_NEWTON_LIMIT):
            self.slip[...] = motion
            with self.watch:
                answer = fixed.iterate(self.driver)
            self.iterations += 1
            assert answer.ddtddg is not None
            stuck = answer.lm == 1
            residual = 2.0 * (motion / dt - velocity) / dt + answer.tau
            tangent = np.moveaxis(answer.ddtddg, -1, 0) + 2.0 / dt**2 * np.eye(2)
            change = -np.linalg.solve(tangent, residual.T[:, :, None])[:, :, 0].T
            # Where a multiplier holds the point: no slip, and the stress that this takes.
            change[:, stuck] = -motion[:, stuck]
            self.multiplier[...] = answer.tau
            self.multiplier[:, stuck] = 2.0 * velocity[:, stuck] / dt
            motion = motion + change
            if not stuck.any() and np.abs(change).max() <= _NEWTON_ACCURACY * np.abs(motion).max():
                self.driver.commit()
                return 2.0 * motion / dt - velocity
        self.driver.cut_back()
        return np.full_like(velocity, np.nan)


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 8,
    steps: int = 64,
    elastic_slip: float = ALLOWABLE,
) -> Outcome:
    """Speed and angle of the particles against the closed form."""
    start, exact = angles(points), Exact(law)
    allowable = positive("P19", "elastic_slip", elastic_slip, ALLOWABLE)
    particles = Particles(routine, law, points, method == "midpoint lagrange", allowable)
    velocity = SPEED * np.array([np.cos(start), np.sin(start)])
    for _ in range(steps):
        velocity = particles.increment(velocity, TIME / steps)
    angle = exact.angle(start)
    speed = exact.speed(angle, start)
    found = np.hypot(*velocity), np.arctan2(velocity[1], velocity[0])
    errors = {
        "speed": float(np.abs(found[0] / speed - 1.0).max()),
        "angle": float(np.abs(found[1] / angle - 1.0).max()),
    }
    return Outcome(
        problem="P19", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=TIME / steps, points=points,
        error=float(np.max(list(errors.values()))), error_of="speed and angle",
        tolerance=TOLERANCES[law] / steps**2,
        details={**errors, "newton_iterations": particles.iterations / steps},
        **particles.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P19",
    title="Oblique slide with two coefficients",
    statement="A particle slides obliquely to two directions with coefficients 0.1 and 0.4; it "
    "brakes and turns to the direction of the smaller one. Friction p diag(mu1, mu2) v/|v|, or "
    "with the slip normal to an ellipse.",
    laws=("orthotropic", "anisotropic"),
    methods={"fric": ("midpoint",), "fric_coef": ("midpoint", "midpoint lagrange")},
    runner=run,
    options={
        "points": "particles with different directions",
        "steps": "increments",
        "elastic_slip": "allowable elastic slip of penalty enforcement",
    },
)
