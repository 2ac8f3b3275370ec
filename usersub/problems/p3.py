# SPDX-License-Identifier: MIT
"""P3: viscoplastic creep under a prescribed shear traction, through FRIC."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import fixed
from usersub.problems.problem import Outcome, Problem, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Slip rate by traction; magnitude of the traction.
CREEP, TRACTION = 1e-3, 100.0

#: Time increments: the answer is exact for any.
INCREMENTS = (1.0, 1.0, 0.125, 7.0, 1.0)

_NEWTON_LIMIT = 10


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 64,
    steps: int | None = None,
) -> Outcome:
    """Newton for the slip of each increment; slip and tangent against the exact ones."""
    increments = INCREMENTS if steps is None else (sum(INCREMENTS) / steps,) * steps
    from usersub import Scene, StandardDriver

    scene = Scene(points=points, dimension=3, props=[CREEP])
    driver = StandardDriver(routine, scene, reuse=True)
    angle = np.linspace(0.1, 6.0, points)
    wanted = np.asfortranarray(TRACTION * np.array([np.cos(angle), np.sin(angle)]))
    dgam = np.zeros((2, points), order="F")
    known = driver.layout.ports
    extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
    driver.bind(slip_increment=dgam, pressure=np.ones(points), **extra)
    driver.begin_increment(1.0)  # closes the contact: no friction yet
    fixed.iterate(driver)
    driver.commit()
    watch, slip, error, iterations = Stopwatch(), np.zeros((2, points)), 0.0, 0
    for dt in increments:
        driver.begin_increment(dt)
        dgam[...] = 0.0
        for _ in range(_NEWTON_LIMIT):
            with watch:
                response = fixed.iterate(driver)
            iterations += 1
            residual = response.tau - wanted
            if np.abs(residual).max() <= 1e-14 * TRACTION:
                break
            tangents = np.moveaxis(response.ddtddg, -1, 0)
            try:
                dgam -= np.linalg.solve(tangents, residual.T[:, :, None])[:, :, 0].T
            except np.linalg.LinAlgError:  # nothing carries the traction
                error = np.inf
                break
        exact_slip, exact_tangent = CREEP * wanted * dt, 1.0 / (CREEP * dt)
        tangent = response.ddtddg - exact_tangent * np.eye(2)[:, :, None]
        slip_error = np.abs(dgam - exact_slip).max() / (CREEP * TRACTION * dt)
        error = np.max([error, slip_error, np.abs(tangent).max() / exact_tangent])
        driver.commit()
        slip += exact_slip
    error = np.max([error, np.abs(driver.array("slip") - slip).max() / np.abs(slip).max()])
    return Outcome(
        problem="P3", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=max(increments), points=points, error=float(error),
        error_of="slip and tangent", tolerance=1e-13,
        details={"newton_iterations": iterations / len(increments)}, **watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P3",
    title="Viscoplastic creep under a prescribed shear traction",
    statement="Contact points carry shear tractions of 100 in different directions; the slip rate "
    "is 1e-3 times the traction. Each unit of time slips 0.1 along the traction, in increments of "
    "any length, and the stress changes by 1/(k dt) with the slip.",
    laws=("viscoplastic_creep",),
    methods={"fric": ("prescribed traction",)},
    runner=run,
    options={
        "points": "contact points",
        "steps": "equal increments instead of some that differ",
    },
)
