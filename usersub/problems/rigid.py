# SPDX-License-Identifier: MIT
"""A rigid block that friction stops, in an explicit host.

The block rests on several contact points of unequal area, which share its weight and its mass.

`central_differences` is the scheme of explicit solvers: the force of an increment is bounded by the
stick force m |v|/dt of the predicted velocity, so that the last increment ends at rest. With a
constant force it is exact; with a force that depends on the slip rate (see `mean_slip`) it is of
second order.

`runge_kutta` takes classical fourth-order steps in time and a last one with the velocity as
independent variable (Henon's step), by Gauss quadrature, which ends exactly at rest.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from usersub import stick_force_kinematic
from usersub.problems.block import NOT_STOPPED, Block, Stop
from usersub.problems.explicit_contact import ExplicitContact, mean_slip

#: Friction force of the whole block: force(velocity, slip, time_increment, time).
Force = Callable[[float, float, float, float], float]

#: Gauss points of the last step of `runge_kutta`.
_GAUSS_POINTS = 6

#: The last step begins when this many ordinary increments would stop the block.
_INCREMENTS_LEFT = 2.5


def contact_areas(block: Block, points: int) -> np.ndarray:
    """Areas of the contact points: all different, in sum that of the block."""
    share = 1.0 + np.arange(points) / points
    return block.area * share / share.sum()


def contact_coordinates(block: Block, points: int, dimension: int) -> np.ndarray:
    """Contact points along the block, shape (dimension, points)."""
    coordinates = np.zeros((dimension, points), order="F")
    coordinates[0] = block.length * (np.arange(points) + 0.5) / points
    return coordinates


def friction_of(block: Block, contact: ExplicitContact, direction: np.ndarray) -> Force:
    """Friction force of the block along `direction`, by predicted velocity and told slip."""
    area = np.asarray(contact.arrays["area"], float)
    area *= block.area / area.sum()
    normal_force = block.pressure * area
    mass = block.mass * area / block.area
    normal = np.zeros((len(direction), contact.points), order="F")
    normal[1] = 1.0
    ones = np.ones(contact.points)

    def force(velocity: float, slip: float, time_increment: float, time: float) -> float:
        speed = np.asfortranarray(np.outer(direction * velocity, ones))
        stick = stick_force_kinematic(speed, normal, mass, time_increment)
        slips = np.outer(direction * slip, ones)
        friction = contact.force(slips, normal_force, stick, time_increment, time)
        return float(-direction @ friction.sum(1))

    return force


def central_differences(
    block: Block, force: Force, time_increment: float, end: float, history: list | None = None
) -> Stop:
    """Explicit central differences until the stick force bounds the friction.

    NaN if that has not happened by the time `end`.
    """
    x, v, t, m = 0.0, block.velocity, 0.0, block.mass
    h = 0.5 * time_increment  # the first increment takes the velocity to the middle of the step
    before = 0.0
    while t < end:
        slip = mean_slip(*(np.array([[a]]) for a in (v, v, -before)), np.array([m]), h)
        # The velocity goes from the middle of one increment to that of the next.
        now = force(v, float(slip[0, 0]), h, t + 0.5 * time_increment)
        if now * h >= v * m * (1.0 - 1e-6):
            # The bound took the share `now/before` of the last increment, counted from where v
            # belongs.
            start, deceleration = t - 0.5 * time_increment, before / m
            at_start = x - 0.5 * v * time_increment + 0.125 * deceleration * time_increment**2
            rest = h * now / before
            return Stop(start + rest, at_start + 0.5 * v * rest)
        v -= now * h / m
        x += v * time_increment
        t += time_increment
        before, h = now, time_increment
        if history is not None:
            history.append((t, x, v, now))
    return NOT_STOPPED


def runge_kutta(
    block: Block, force: Force, time_increment: float, end: float, history: list | None = None
) -> Stop:
    """Fourth-order steps in time, the last one over the velocity.

    NaN if the last one has not begun by the time `end`.
    """
    x, v, t, dt, m = 0.0, block.velocity, 0.0, time_increment, block.mass
    while t < end:
        a = force(v, v * dt, dt, t) / m
        if v <= _INCREMENTS_LEFT * a * dt:
            return _over_the_velocity(m, force, x, v, t, a)
        v2 = v - 0.5 * dt * a
        a2 = force(v2, v2 * dt, dt, t) / m
        v3 = v - 0.5 * dt * a2
        a3 = force(v3, v3 * dt, dt, t) / m
        v4 = v - dt * a3
        a4 = force(v4, v4 * dt, dt, t) / m
        x += dt * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0
        v -= dt * (a + 2.0 * a2 + 2.0 * a3 + a4) / 6.0
        t += dt
        if history is not None:
            history.append((t, x, v, m * a4))
    return NOT_STOPPED


def _over_the_velocity(m: float, force: Force, x: float, v: float, t: float, a: float) -> Stop:
    """From the velocity `v` with the deceleration `a` to rest."""
    nodes, weights = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    time, distance = t, x
    for node, weight in zip(nodes, weights, strict=True):
        u = 0.5 * v * (node + 1.0)
        # In a short increment the stick force stays well above the friction.
        short = u / (4.0 * a)
        inverse = m / force(u, u * short, short, t)
        time += 0.5 * v * weight * inverse
        distance += 0.5 * v * weight * u * inverse
    return Stop(float(time), float(distance))
