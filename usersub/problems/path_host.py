# SPDX-License-Identifier: MIT
"""Contact points that are moved along given paths, through any interface that carries the law.

Every point goes its own straight way, forth and back, in its own direction; all go the same motion.
Nothing is integrated by the host, so what is left is what the law does in an increment.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub import laws
from usersub.problems import fixed
from usersub.problems.explicit_contact import ExplicitContact
from usersub.problems.problem import Outcome, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Pressure of all points, unless a problem has its own.
PRESSURE = 4.0

#: More than any friction: the points are moved, whatever holds them.
_NO_STICK = 1e30


def directions(points: int) -> np.ndarray:
    """Directions of the ways, shape (2, points); none along an axis."""
    angle = 0.3 + 5.0 * np.arange(points) / points
    return np.array([np.cos(angle), np.sin(angle)])


class _Standard:
    """Through FRIC and FRIC_COEF."""

    def __init__(
        self, routine: Routine, law: str, props: list[float], points: int, allowable: float
    ) -> None:
        from usersub import Scene, StandardDriver

        interface = routine.interface.name
        scene = Scene(
            points=points, dimension=3, props=props, characteristic_length=200.0 * allowable,
            states=laws.law(law).state_count(interface, 2, 3, props),
        )  # fmt: skip
        self.driver = StandardDriver(routine, scene, reuse=True)
        self.motion, self.pressure = np.zeros((2, points), order="F"), np.ones(points)
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        self.driver.bind(slip_increment=self.motion, pressure=self.pressure, **extra)
        self.along = directions(points)

    def start(self, elastic: float) -> None:
        """Closes the contact, then brings the elastic slip to its limit; both take no time."""
        for motion in (0.0, elastic)[: 1 if elastic == 0.0 else 2]:
            self.motion[...] = motion * self.along
            self.driver.begin_increment(0.0)
            fixed.iterate(self.driver)
            self.driver.commit()

    def move(self, motion: float, pressure: float, dt: float, watch: Stopwatch) -> np.ndarray:
        """Tractions after one increment, shape (2, points)."""
        self.motion[...], self.pressure[...] = motion * self.along, pressure
        self.driver.begin_increment(dt)
        with watch:
            response = fixed.iterate(self.driver)
        self.driver.commit()
        return response.tau


class _Explicit:
    """Through VFRIC and VFRICTION."""

    def __init__(
        self, routine: Routine, law: str, props: list[float], points: int, precision: str
    ) -> None:
        place = np.zeros((3, points))
        place[0] = np.arange(points)
        self.area = 1.0 + 0.5 * np.arange(points) / points
        states = laws.law(law).state_count(routine.interface.name, 2, 3, props)
        self.contact = ExplicitContact(
            routine, props, place, self.area, precision=precision, states=states
        )
        self.along, self.time = directions(points), 0.0

    def move(self, motion: float, pressure: float, dt: float, watch: Stopwatch) -> np.ndarray:
        """Tractions after one increment, shape (2, points)."""
        slip = np.zeros((3, self.area.size))
        slip[[0, 2]] = motion * self.along
        self.time += dt
        with watch:
            force = self.contact.force(
                slip, pressure * self.area, np.full(self.area.size, _NO_STICK), dt, self.time
            )
        return -force[[0, 2]] / self.area


class Path:
    """Points of a law on their ways.

    Args:
        law: name of the law behind the routine.
        allowable: elastic slip of penalty enforcement (FRIC and FRIC_COEF of a coefficient), which
            is used up before the ways begin.
    """

    def __init__(
        self, routine: Routine, law: str, props: list[float], points: int, precision: str,
        allowable: float = 1.0,
    ) -> None:  # fmt: skip
        self.points, self.along = points, directions(points)
        if routine.interface.name.startswith("v"):
            self._host: _Standard | _Explicit = _Explicit(routine, law, props, points, precision)
        else:
            host = _Standard(routine, law, props, points, allowable)
            host.start(allowable if laws.law(law).kind == "coefficient" else 0.0)
            self._host = host
        self.watch = Stopwatch()

    def move(self, motion: float, dt: float, pressure: float = PRESSURE) -> np.ndarray:
        """Traction along each point's way after one increment; NaN where it has another direction.

        Args:
            motion: of all points, each along its way, or back where it is negative.
        """
        tau = self._host.move(motion, pressure, dt, self.watch)
        found = (tau * self.along).sum(0)
        across = tau[1] * self.along[0] - tau[0] * self.along[1]
        return np.where(np.abs(across) <= 1e-3 * pressure, found, np.nan)


def worst(found: np.ndarray, exact: float, size: float | None = None) -> float:
    """Largest error, relative to `size` (the exact value unless it is given)."""
    return float(np.abs(found - exact).max() / abs(exact if size is None else size))


def outcome(
    problem: str, routine: Routine, law: str, precision: str, method: str, path: Path,
    errors: dict[str, float], tolerance: float, step: float, error_of: str,
) -> Outcome:  # fmt: skip
    """The outcome of a problem with the errors in `errors`."""
    return Outcome(
        problem=problem, law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=step, points=path.points,
        error=float(np.max(list(errors.values()))), error_of=error_of, tolerance=tolerance,
        details=errors, **path.watch.times(path.points),
    )  # fmt: skip
