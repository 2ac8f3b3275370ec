# SPDX-License-Identifier: MIT
"""P10: a sphere pressed on a plane and dragged: partial slip after Cattaneo and Mindlin."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usersub.problems.choose import positive
from usersub.problems.linear_host import LinearHost, Springs, make_driver
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Normal force, radius of the contact, coefficient, tangential flexibility C = 2 (2 - nu)/G of two
#: like bodies. Poisson's ratio is zero: then slip has one direction and the answer is exact.
NORMAL, RADIUS, MU, FLEXIBILITY = 60.0, 0.8, 0.35, 4.0 / 900.0

#: Tangential force, as a share of the one that makes everything slip: half the radius sticks. The
#: edge of that part then lies a third or two thirds into a ring, whatever power of two there are.
SHARE = 0.875
FORCE = SHARE * MU * NORMAL

#: Allowable elastic slip of the penalty method, far below the motion.
ALLOWABLE = 1e-9


class Exact(NamedTuple):
    """Radius of the part that sticks over that of the contact and motion of the bodies, under the
    largest force; dissipation of a closed loop between it and its opposite."""

    stuck: float
    motion: float
    loop: float


def exact() -> Exact:
    """Cattaneo (1938), Mindlin (1949), Mindlin and Deresiewicz (1953)."""
    q = SHARE
    unit = MU * NORMAL * FLEXIBILITY / RADIUS
    rest = (1.0 - q) ** (2.0 / 3.0)
    loop = 1.0 - (1.0 - q) ** (5.0 / 3.0) - (5.0 * q / 6.0) * (1.0 + rest)
    return Exact(
        (1.0 - q) ** (1.0 / 3.0), 3.0 / 16.0 * unit * (1.0 - rest), 0.9 * unit * MU * NORMAL * loop
    )


def _elliptic(m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Complete elliptic integrals K and E of the parameter m < 1, by the arithmetic-geometric
    mean."""
    a, b = np.ones_like(m), np.sqrt(1.0 - m)
    c, weight = np.sqrt(m), 0.5
    missing = weight * c * c
    for _ in range(40):
        a, b, c = 0.5 * (a + b), np.sqrt(a * b), 0.5 * (a - b)
        weight *= 2.0
        missing = missing + weight * c * c
        if np.abs(c).max() <= 1e-17:
            break
    k = 0.5 * math.pi / a
    return k, k * (1.0 - missing)


def _circle(r: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Motion at radius r (not b) under unit stress inside radius b; kernel C/(4 pi distance)."""
    scale = FLEXIBILITY / math.pi
    small, large = np.minimum(r, b), np.maximum(r, b)
    ratio = (small / large) ** 2
    k, e = _elliptic(ratio)
    return scale * np.where(r < b, b * e, r * (e - (1.0 - ratio) * k))


class Rings(NamedTuple):
    """Rings of the contact, one contact point each: outer radii, middles, areas, pressures."""

    outer: np.ndarray
    middle: np.ndarray
    area: np.ndarray
    pressure: np.ndarray


def rings(points: int) -> Rings:
    """Narrower towards the edge; the pressures are the means of Hertz's over each ring."""
    bound = RADIUS * np.sin(0.5 * math.pi * np.arange(points + 1) / points)
    inner, outer = bound[:-1], bound[1:]
    area = math.pi * (outer**2 - inner**2)
    left = np.maximum(0.0, 1.0 - (bound / RADIUS) ** 2) ** 1.5  # share of the load outside
    return Rings(outer, 0.5 * (inner + outer), area, NORMAL * (left[:-1] - left[1:]) / area)


def springs(contact: Rings) -> Springs:
    """Unknowns are the slips of the rings and the motion of the bodies far away, which is given."""
    r, points = contact.middle[:, None], contact.middle.size
    up_to = _circle(r, contact.outer[None, :])
    flexibility = np.diff(up_to, axis=1, prepend=0.0)
    held = contact.area[:, None] * np.linalg.inv(flexibility)
    rows = np.hstack([held, -held.sum(1, keepdims=True)])
    slip = np.eye(points, points + 1)
    return Springs(
        slip, slip.T * contact.area, np.vstack([rows, np.eye(1, points + 1, points)]),
        contact.pressure,
    )  # fmt: skip


def _stick_radius(contact: Rings, slip: np.ndarray) -> float:
    """Where the slip begins: it grows with the power 3/2 of the distance from there."""
    first = int(np.argmax(np.abs(slip) > 1e-6 * np.abs(slip).max())) + 1
    r, s = contact.middle[first : first + 2], np.abs(slip[first : first + 2]) ** (2.0 / 3.0)
    if not s[1] > s[0]:
        return math.nan
    return float(r[0] - s[0] * (r[1] - r[0]) / (s[1] - s[0])) / RADIUS


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 32,
    steps: int = 4,
    elastic_slip: float = ALLOWABLE,
) -> Outcome:
    """Drag, drag back, and forth again: force, stick radius, dissipation of the loop."""
    contact = rings(points)
    allowable = positive("P10", "elastic_slip", elastic_slip, ALLOWABLE)
    driver = make_driver(
        routine, [MU], points, directions=2, allowable=allowable, lagrange=method == "lagrange"
    )
    host, load = LinearHost(driver, springs(contact), 1e3), np.zeros(points + 1)
    answer = exact()

    def drag(begin: float, end: float) -> float:
        count = steps * round(abs(end - begin))
        for i in range(count):
            load[-1] = answer.motion * (begin + (end - begin) * (i + 1.0) / count)
            host.solve(load)
        return float(contact.area @ host.stress)

    force = drag(0.0, 1.0)
    beyond = np.maximum(np.abs(host.unknowns[:-1]) - allowable * (method == "penalty"), 0.0)
    stuck = _stick_radius(contact, beyond)
    drag(1.0, -1.0)
    drag(-1.0, 1.0)
    before = host.dissipated
    drag(1.0, -1.0)
    again = drag(-1.0, 1.0)
    loop = float(contact.area @ (host.dissipated - before))
    errors = {
        "force": abs(force / FORCE - 1.0),
        "loop": abs(loop / answer.loop - 1.0),
        "stick_radius": abs(stuck / answer.stuck - 1.0),
    }
    return Outcome(
        problem="P10", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=1.0, points=points,
        error=float(np.max(list(errors.values()))), error_of="force, loop and stick radius",
        tolerance=4.0 / points**2 + 0.06 / points,
        details={**errors, "closed": abs(again - force) / FORCE,
                 "across": host.across / (MU * contact.pressure.max()),
                 "newton_iterations": host.iterations / host.increments},
        **host.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P10",
    title="Sphere dragged over a plane with partial slip",
    statement="Two elastic bodies in Hertzian contact are dragged against each other by a force "
    "below the friction limit: a ring slips, the inside sticks. Radius of the part that sticks, "
    "motion of the bodies and dissipation of a loop are those of Cattaneo and Mindlin.",
    laws=("coulomb",),
    methods={"fric": ("penalty",), "fric_coef": ("penalty", "lagrange")},
    runner=run,
    options={
        "points": "contact points, one a ring",
        "steps": "increments from zero to the force",
        "elastic_slip": "allowable elastic slip of penalty enforcement",
    },
)
