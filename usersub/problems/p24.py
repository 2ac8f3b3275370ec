# SPDX-License-Identifier: MIT
"""P24: energy on every increment: what the friction stress does is stored or dissipated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np

from usersub.errors import SceneError
from usersub.problems import fixed
from usersub.problems.problem import Outcome, Problem, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

MU, PRESSURE = 0.3, 100.0

#: Elastic slip at which the bound is reached, and the stiffness of sticking.
REACH = 0.01
SLOPE = MU * PRESSURE / REACH

#: Tangential damping of the explicit driver, small against SLOPE times the time increment.
_DAMPING, _TIME_INCREMENT = 100.0, 0.1

#: Increments of the loop that stays elastic; of the straight way, and its length by REACH.
_LOOP, _STRAIGHT, _LENGTH = 24, 60, 8.0


class _Contact(Protocol):
    """Energies of contact points, all by area; they are sums where the driver tells no more."""

    watch: Stopwatch

    def elastic_slip(self) -> np.ndarray:
        """Of each point, shape (2, points)."""

    def slide(self, motion: np.ndarray) -> None:
        """One increment; `motion` has shape (2, points)."""

    def book(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Elastic energy, dissipation so far; work less ½ d.Kd of the last increment."""


class _Standard:
    """Through FRIC and FRIC_COEF."""

    def __init__(self, routine: Routine, points: int, softened: bool) -> None:
        from usersub import Scene, StandardDriver

        self.by_routine = routine.interface.name == "fric"
        # Both take the allowable elastic slip as 0.005 of the characteristic length.
        stick = {"stick_slope": SLOPE} if softened else {"characteristic_length": 200.0 * REACH}
        scene = Scene(
            points=points, dimension=3, props=[MU], states=2 if self.by_routine else 0, **stick
        )
        self.driver = StandardDriver(routine, scene, reuse=True)
        self.motion = np.zeros((2, points), order="F")
        known = self.driver.layout.ports
        extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
        self.driver.bind(slip_increment=self.motion, pressure=np.full(points, PRESSURE), **extra)
        self.sfd, self.work = np.zeros(points), np.zeros(points)
        self.watch = Stopwatch()
        self.slide(np.zeros((2, points)))  # closes the contact: no friction yet

    def elastic_slip(self) -> np.ndarray:
        """Of each point."""
        name = "state" if self.by_routine else "elastic_slip"
        return self.driver.state[name][:2].copy()

    def slide(self, motion: np.ndarray) -> None:
        """One increment."""
        self.motion[...] = motion
        before = self.elastic_slip()
        self.driver.begin_increment(_TIME_INCREMENT)
        with self.watch:
            response = fixed.iterate(self.driver)
        self.driver.commit()
        change = self.elastic_slip() - before
        self.sed = response.sed.copy()
        self.sfd += response.sfd
        self.work = (response.tau * motion).sum(0) - 0.5 * SLOPE * (change**2).sum(0)

    def book(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Point by point."""
        return self.sed, self.sfd.copy(), self.work


class _Explicit:
    """Through VFRIC_COEF with penalty enforcement and damping."""

    def __init__(self, routine: Routine, points: int, precision: str) -> None:
        from usersub import ExplicitDriver, Scene

        scene = Scene(
            points=points, dimension=3, precision=precision, props=[MU], enforcement="penalty",
            stick_slope=SLOPE, damping=_DAMPING, dissipation=1,
        )  # fmt: skip
        self.driver = ExplicitDriver(routine, scene, reuse=True)
        real = np.float64 if precision == "double" else np.float32
        self.slip = np.zeros((3, points), real, order="F")
        normal = np.zeros((3, points), real, order="F")
        normal[1] = 1.0
        force = np.full(points, PRESSURE, real)
        self.driver.bind(slip_increment=self.slip, normal=normal, normal_force=force)
        self.dissipation = self.work = 0.0
        self.watch = Stopwatch()

    def elastic_slip(self) -> np.ndarray:
        """Of each point, in the plane."""
        return self.driver.state["elastic_slip"][[0, 2]].astype(float)

    def slide(self, motion: np.ndarray) -> None:
        """One increment."""
        self.slip[0], self.slip[2] = motion
        before = self.elastic_slip()
        with self.watch:
            response = self.driver.step(_TIME_INCREMENT)
        change = self.elastic_slip() - before
        done = -(response.force.astype(float) * self.slip).sum()
        self.dissipation = response.dissipation
        self.work = done - 0.5 * SLOPE * (change**2).sum()

    def book(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Sums over the points."""
        sums = self.driver.elastic_energy, self.dissipation, self.work
        return tuple(np.array([value]) for value in sums)  # type: ignore[return-value]


def _path(points: int, increments: int) -> np.ndarray:
    """Motions of all increments, shape (increments, 2, points): swings that turn.

    They reach beyond the elastic slip in all directions, differently for each point.
    """
    phase = np.linspace(0.0, 1.0, increments + 1)[:, None]
    point = np.arange(points) / points
    radius = REACH * (3.0 + point) * np.sin(2.0 * np.pi * 3.0 * phase)
    angle = 2.0 * np.pi * (phase + point)
    places = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    return np.diff(places, axis=0)


def _loop(points: int) -> np.ndarray:
    """A closed loop of small motions, which every point makes without slip."""
    angle = np.linspace(0.0, 2.0 * np.pi, _LOOP + 1)[:, None] + np.arange(points)
    places = 0.2 * REACH * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.diff(places, axis=0)


def _straight(contact: _Contact, points: int, damped: bool) -> dict[str, float]:
    """A long straight slip: what it stores, and what it dissipates, in closed form."""
    way = np.tile([[0.6], [0.8]], (1, points)) * _LENGTH * REACH / _STRAIGHT
    for _ in range(_STRAIGHT):
        contact.slide(way)
    bound, share = MU * PRESSURE, points if damped else 1
    stored, lost, _ = contact.book()
    errors = {"stored": stored - 0.5 * bound * REACH * share}
    if not damped:  # the dashpot carries a part of the bound at first
        errors["dissipated"] = lost - bound * REACH * (_LENGTH - 1.0) * share
    return {name: float(np.abs(error).max()) for name, error in errors.items()}


def _follow(contact: _Contact, motions: np.ndarray) -> dict[str, float]:
    """Largest defect of the balance, and what would be dissipation below zero."""
    energy, lost, _ = contact.book()
    energy = energy.copy()
    defect = gained = 0.0
    for motion in motions:
        contact.slide(motion)
        energy_now, lost_now, work = contact.book()
        stored, dissipated = energy_now - energy, lost_now - lost
        defect = max(defect, float(np.abs(stored + dissipated - work).max()))
        gained = max(gained, float((-dissipated).max()))
        energy, lost = energy_now.copy(), lost_now
    return {"balance": defect, "negative dissipation": max(gained, 0.0)}


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 5,
    steps: int = 240,
) -> Outcome:
    """A straight slip, a winding path, and a closed elastic loop. Errors by K reach^2 / 2."""
    if steps < 1:
        raise SceneError(f"problem P24: steps is {steps}, expected 1 or more")
    explicit = routine.interface.name == "vfric_coef"
    contact = (
        _Explicit(routine, points, precision)
        if explicit
        else _Standard(routine, points, method == "softened")
    )
    scale = 0.5 * SLOPE * REACH**2 * (points if explicit else 1)
    straight = _straight(contact, points, explicit)
    errors = _follow(contact, _path(points, steps))
    # From the bound to the inside, so that the loop has room, and around.
    contact.slide(-0.5 * contact.elastic_slip())
    before, lost, _ = contact.book()
    before = before.copy()
    around = _follow(contact, _loop(points))
    after, lost_after, _ = contact.book()
    errors = {name: max(errors[name], around[name]) for name in errors}
    errors["loop"] = float(np.abs(after - before).max())
    if not explicit:  # damping takes its share even of an elastic loop
        errors["loss of the loop"] = float(np.abs(lost_after - lost).max())
    errors = {name: error / scale for name, error in {**straight, **errors}.items()}
    return Outcome(
        problem="P24", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=_TIME_INCREMENT, points=points,
        error=float(np.max([*errors.values()])), error_of=", ".join(errors),
        tolerance=1e-12 if precision == "double" else 1e-5, details=errors,
        **contact.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P24",
    title="Energy on every increment",
    statement="Contact points slip straight on, then to and fro beyond their elastic slip, in "
    "directions that turn. In every increment the change of elastic energy and dissipation is the "
    "work of the friction stress: of the stress at the end, less half of d.Kd with the change d of "
    "the elastic slip. Dissipation never falls, a closed loop without slip loses nothing, and the "
    "straight slip stores and dissipates what its closed form says.",
    laws=("coulomb",),
    methods={
        "fric": ("elastic slip",),
        "fric_coef": ("elastic slip", "softened"),
        "vfric_coef": ("softened, damped",),
    },
    runner=run,
    options={"points": "contact points", "steps": "increments of the path"},
)
