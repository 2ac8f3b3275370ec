# SPDX-License-Identifier: MIT
"""P12: a belt on a drum: the tensions at both ends when it begins to slide."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from usersub.problems.linear_host import LinearHost, Springs, make_driver
from usersub.problems.problem import Outcome, Problem

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Coefficient, wrapped angle, radius and width; axial stiffness; tension of the slack end.
MU, WRAP, RADIUS, WIDTH = 0.3, 1.25 * math.pi, 0.4, 0.05
STIFFNESS, SLACK = 2e4, 150.0

#: Motion of the taut end, which makes the whole belt slide; allowable elastic slip.
PULL, ALLOWABLE = 0.08, 1e-5


def exact() -> float:
    """Taut over slack tension of the continuous belt."""
    return math.exp(MU * WRAP)


def of_polygon(points: int) -> float:
    """The same of a belt that is bent at `points` corners, each with its friction."""
    turn = MU * math.tan(0.5 * WRAP / points)
    return ((1.0 + turn) / (1.0 - turn)) ** points


def springs(points: int) -> Springs:
    """The belt: motions of the corners, then that of the taut end; tensions are SLACK + T x.

    Along the drum the tensions of the two straight parts balance the friction, across it they make
    the normal force.
    """
    half = 0.5 * WRAP / points
    area = WIDTH * RADIUS * WRAP / points
    k = STIFFNESS / (RADIUS * WRAP / points)
    tension = np.zeros((points + 1, points + 1))  # of the parts before each corner, and the last
    for i in range(1, points + 1):
        tension[i, i - 1], tension[i, i] = -k, k
    along = (tension[1:] - tension[:-1]) * math.cos(half)
    across = (tension[1:] + tension[:-1]) * math.sin(half)
    slip = np.eye(points, points + 1)
    stiffness = np.vstack([-along, np.eye(1, points + 1, points)])
    return Springs(
        slip, slip.T * area, stiffness, np.full(points, 2.0 * SLACK * math.sin(half) / area),
        across / area,
    )  # fmt: skip


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 32,
    steps: int = 4,
) -> Outcome:
    """The taut end is pulled until the whole belt slides."""
    driver = make_driver(
        routine, [MU], points, directions=1, allowable=ALLOWABLE, lagrange=method == "lagrange"
    )
    belt = springs(points)
    host, load = LinearHost(driver, belt, 1e3), np.zeros(points + 1)
    for i in range(steps):
        load[-1] = PULL * (i + 1.0) / steps
        x = host.solve(load)
    k = STIFFNESS / (RADIUS * WRAP / points)
    found = math.log(1.0 + k * (x[-1] - x[-2]) / SLACK)
    # That of the polygon is 2 n artanh(mu tan(wrap/2n)): its first term beyond mu wrap.
    missing = WRAP**2 * (1.0 + MU**2) / (12.0 * points**2)
    errors = {"logarithm": abs(found / math.log(exact()) - 1.0),
              "polygon": abs(found / math.log(of_polygon(points)) - 1.0)}  # fmt: skip
    return Outcome(
        problem="P12", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=1.0, points=points, error=errors["logarithm"],
        error_of="logarithm of the ratio of tensions", tolerance=1.1 * missing,
        details={**errors, "newton_iterations": host.iterations / host.increments},
        **host.watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P12",
    title="Belt on a drum",
    statement="An elastic belt lies around a drum over an angle; coefficient 0.3. One end is held "
    "by a force, the other is pulled until the whole belt slides: the ratio of the tensions is "
    "exp(mu angle), as the pressure of each place follows from the tension there.",
    laws=("coulomb",),
    methods={"fric": ("penalty",), "fric_coef": ("penalty", "lagrange")},
    runner=run,
    options={"points": "contact points", "steps": "increments"},
)
