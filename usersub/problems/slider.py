# SPDX-License-Identifier: MIT
"""A mass that rubs, alone or on springs: what problems P5 to P8 share.

Between two events - a sliding mass comes to rest, a sticking one breaks loose - Coulomb friction is
constant and the motion known in closed form. `follow` goes from event to event: the friction and
the decision to stick are the driver's, the motion is exact, and the events are found by bisection.
So its answers are exact, up to rounding, wherever the coefficient is constant in slip.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

#: Positions and velocities of all masses, the rubbing one first.
State = tuple[np.ndarray, np.ndarray]

#: Slip rate of a mass that nothing holds and that nothing pushes yet.
_SLOW = 1e-12

#: Halvings that bring an interval of floating-point numbers down to neighbours.
_HALVINGS = 80


class System(Protocol):
    """Masses with exact motions.

    Attributes:
        masses: of the rubbing mass, then of others.
        normal_force: on the rubbing mass.
        start: at time zero.
        breaks: times at which loads change; increments end there.
    """

    masses: np.ndarray
    normal_force: float
    start: State
    breaks: tuple[float, ...]

    def forces(self, x: np.ndarray, time: float) -> np.ndarray:
        """Forces on all masses but friction."""

    def slide(self, state: State, time: float, friction: float, dt: float) -> State:
        """Motion under a constant friction force on the rubbing mass."""

    def stick(self, state: State, time: float, dt: float) -> State:
        """Motion while the rubbing mass moves with the ground."""

    def ground(self, time: float) -> tuple[float, float, float]:
        """Displacement, velocity and acceleration of the ground."""


class Fixed:
    """The ground of most systems."""

    breaks: tuple[float, ...] = ()

    def ground(self, time: float) -> tuple[float, float, float]:
        """Displacement, velocity and acceleration of the ground."""
        return 0.0, 0.0, 0.0


@dataclass(frozen=True)
class Event:
    """The rubbing mass comes to rest ("rest") or slips ("slip"), or a load changes ("break")."""

    kind: str
    time: float
    x: np.ndarray
    v: np.ndarray


class Contact(Protocol):
    """Friction of the rubbing mass by a driver; an answer counts once it is accepted."""

    def slide(self, move: Callable[[float], float], rate: float, dt: float, time: float) -> float:
        """Friction force while it slides; `move` gives the slip of the increment by the force."""

    def stick(self, load: float, dt: float, time: float) -> float | None:
        """The motion in which it carries `load` by sticking, mostly zero; None if it slips."""

    def accept(self) -> None:
        """The last answer is that of the increment."""

    def reject(self) -> None:
        """The last answer was a trial."""


def oscillation(
    x: np.ndarray, v: np.ndarray, centre: float, frequency: float, dt: float
) -> tuple[np.ndarray, np.ndarray]:
    """Harmonic motion about a constant centre."""
    c, s = np.cos(frequency * dt), np.sin(frequency * dt)
    return centre + (x - centre) * c + v / frequency * s, v * c - (x - centre) * frequency * s


def load_of(system: System, state: State, time: float) -> float:
    """Force that friction has to balance for the rubbing mass to move with the ground."""
    inertia = system.masses[0] * system.ground(time)[2]
    return float(system.forces(state[0], time)[0] - inertia)


def rate_of(system: System, state: State, time: float) -> float:
    """Slip rate of the rubbing mass against the ground."""
    return float(state[1][0] - system.ground(time)[1])


def bisect(inside: Callable[[float], bool], low: float, high: float) -> float:
    """The largest number found at which `inside` holds; it does at `low` and not at `high`."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        low, high = (middle, high) if inside(middle) else (low, middle)
    return low


class Follower:
    """Goes from event to event."""

    def __init__(self, system: System, contact: Contact, increment: float) -> None:
        self.system, self.contact, self.increment = system, contact, increment
        self.time, self.state = 0.0, system.start
        self.events: list[Event] = []
        self.sticks = False
        self.direction = float(np.sign(rate_of(system, self.state, 0.0)))
        if self.direction == 0.0:
            self._rest()

    def follow(self, end: float, count: int | None = None) -> list[Event]:
        """Events up to a time, or until there are `count`."""
        while self.time < end and (count is None or len(self.events) < count):
            nearest = min([t for t in self.system.breaks if t > self.time] + [end])
            dt = min(self.increment, nearest - self.time)
            at_break = dt == nearest - self.time and nearest in self.system.breaks
            if (self._stick(dt) if self.sticks else self._slide(dt)) and at_break:
                self.time = nearest
                self._note("break")
        return self.events

    def hold(self, count: int) -> float:
        """Sticks for `count` increments without load changes; the largest creep in them."""
        load, creep, largest = load_of(self.system, self.state, self.time), 0.0, 0.0
        for _ in range(count):
            moved = self.contact.stick(load, self.increment, self.time)
            if moved is None:
                return np.inf
            self.contact.accept()
            creep += moved
            largest = max(largest, abs(creep))
        return largest

    def _note(self, kind: str) -> None:
        x, v = self.state
        self.events.append(Event(kind, self.time, x.copy(), v.copy()))

    def _to(self, state: State, dt: float) -> None:
        self.state, self.time = state, self.time + dt

    def _rest(self) -> None:
        """Rests on the ground: sticks, or slips at once the way it is pushed."""
        self.state[1][0] = self.system.ground(self.time)[1]
        load = load_of(self.system, self.state, self.time)
        self.sticks = self.contact.stick(load, self.increment, self.time) is not None
        self.contact.reject()
        if load == 0.0 and not self.sticks:  # nothing holds it: it goes where it is pushed next
            soon = self.system.stick(self.state, self.time, self.increment)
            load = load_of(self.system, soon, self.time + self.increment)
        self.direction = float(np.sign(load))

    def _stick(self, dt: float) -> bool:
        """An increment of sticking, whole or up to where it breaks loose."""
        system, time, before = self.system, self.time, self.state

        def holds(share: float) -> bool:
            state = system.stick(before, time, share)
            load = load_of(system, state, time + share)
            self.moved = self.contact.stick(load, self.increment, time + share)
            if self.moved is None:
                self.direction = float(np.sign(load))
            return self.moved is not None

        def would_hold(share: float) -> bool:
            found = holds(share)
            self.contact.reject()
            return found

        whole = holds(dt)
        if not whole:
            self.contact.reject()
            dt = bisect(would_hold, 0.0, dt)
            if not holds(dt):
                raise ArithmeticError(f"the mass does not stick at the time {time:g}")
        self.contact.accept()
        x, v = system.stick(before, time, dt)
        x[0] += self.moved
        self._to((x, v), dt)
        if not whole:
            self.sticks = False
            self._note("slip")
        return whole

    def _slide(self, dt: float) -> bool:
        """An increment of sliding, whole or up to where it comes to rest."""
        system, time, before, way = self.system, self.time, self.state, self.direction

        def slip(friction: float, share: float) -> float:
            x = system.slide(before, time, friction, share)[0][0]
            return float(x - before[0][0] - system.ground(time + share)[0] + system.ground(time)[0])

        def forward(share: float) -> bool:
            state = system.slide(before, time, friction, share)
            return rate_of(system, state, time + share) * way > 0.0

        gained = abs(load_of(system, before, time)) * dt / system.masses[0]
        rate = rate_of(system, before, time) or way * max(gained, _SLOW)
        friction = self.contact.slide(lambda f: slip(f, dt), rate, dt, time)
        whole = forward(dt)
        if not whole:
            self.contact.reject()
            dt = bisect(forward, 0.0, dt)
            if dt == 0.0:
                raise ArithmeticError(f"the mass neither slides nor sticks at the time {time:g}")
            friction = self.contact.slide(lambda f: slip(f, dt), rate, dt, time)
        self.contact.accept()
        self._to(system.slide(before, time, friction, dt), dt)
        if not whole:
            self._rest()
            self._note("rest")
        return whole
