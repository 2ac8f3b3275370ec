# SPDX-License-Identifier: MIT
"""Runs of the block through any of the five interfaces: what P1 and P2 share."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from usersub.problems import block_fe, block_implicit, elements, rigid
from usersub.problems.block import Block, Stop
from usersub.problems.explicit_contact import ANALYTICAL, FACET, ExplicitContact
from usersub.problems.problem import Outcome

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

_EXPLICIT_METHODS = (
    "rigid", "rigid rk4", "CPE3", "C3D8R",
)  # fmt: skip

#: Hosts and time integrations by interface.
METHODS = {
    "vfric": _EXPLICIT_METHODS,
    "vfriction": (*_EXPLICIT_METHODS, "CPE3 analytical", "C3D8R analytical"),
    "vfric_coef": _EXPLICIT_METHODS,
    "fric": ("implicit", "implicit Romberg"),
    "fric_coef": ("implicit", "implicit Romberg"),
}

OPTIONS = {
    "points": "contact points of the rigid block",
    "steps": "increments until the block stands still, about",
    "history": "True to keep time, distance, velocity and friction force",
}

#: Relative errors of time and distance that a finite-element run may have; the time is that of the
#: manual's own finite-element answer.
FE_TOLERANCE = Stop(2.5e-3, 5e-4)


def run_block(
    name: str,
    block: Block,
    exact: Stop,
    props: list[float],
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    tolerance: float,
    *,
    points: int = 64,
    steps: int = 64,
    history: bool = False,
) -> Outcome:
    """One run of the block, compared with `exact`.

    Args:
        tolerance: relative error that the rigid block may have in double precision; single
            precision is allowed its own rounding.
    """
    rows: list | None = [] if history else None
    details: dict[str, float] = {}
    if method.startswith("implicit"):
        made = block_implicit.run(block, exact, props, routine, method, points, steps, rows)
        stop, watch, step, details = made
    elif method.startswith("rigid"):
        stop, watch, step = _rigid(block, exact, props, routine, precision, method, points, steps, rows)
    else:
        stop, watch, step, points = _finite_elements(
            block, exact, props, routine, precision, method, rows
        )
    time_error, distance_error = stop.error(exact)
    error, allowed = max(time_error, distance_error), tolerance
    if method.startswith("C"):
        # In units of what each may be off, so that one number tells.
        error = max(
            time_error, distance_error * FE_TOLERANCE.time / FE_TOLERANCE.distance
        )
        allowed = FE_TOLERANCE.time
    elif precision == "single":
        allowed = max(tolerance, 1e-5)
    return Outcome(
        problem=name,
        law=law,
        interface=routine.interface.name,
        language=routine.language,
        precision=precision,
        method=method,
        step=step,
        points=points,
        error=error,
        error_of="stopping time and distance",
        tolerance=allowed,
        details={"time_error": time_error, "distance_error": distance_error, **details},
        history=_arrays(rows),
        **watch.times(points),
    )


def _arrays(rows: list | None) -> dict[str, np.ndarray] | None:
    if not rows:
        return None
    columns = np.array(rows, float).T
    return dict(zip(("time", "distance", "velocity", "friction_force"), columns, strict=True))


def _rigid(block, exact, props, routine, precision, method, points, steps, rows):
    dimension = 2 if routine.interface.name == "vfric" else 3
    direction = np.zeros(dimension)
    direction[0], direction[2:] = (1.0, 0.0) if dimension == 2 else (0.8, 0.6)
    contact = ExplicitContact(
        routine, props, rigid.contact_coordinates(block, points, dimension),
        rigid.contact_areas(block, points), precision=precision, block=0,
    )  # fmt: skip
    force = rigid.friction_of(block, contact, direction)
    # Not a divisor of the stopping time: the last increment has to be shortened.
    step = exact.time / (steps - 0.37)
    scheme = rigid.runge_kutta if method == "rigid rk4" else rigid.central_differences
    return scheme(block, force, step, rows), contact.watch, step


def _finite_elements(block, exact, props, routine, precision, method, rows):
    element, _, plane = method.partition(" ")
    mesh = elements.triangles(block) if element == "CPE3" else elements.hexahedra(block)
    contact = ExplicitContact(
        routine, props, mesh.coordinates[mesh.bottom].T, mesh.area, precision=precision,
        contact=ANALYTICAL if plane else FACET,
    )  # fmt: skip
    host = block_fe.FiniteElementBlock(block, mesh, contact)
    stop = host.run(1.5 * exact.time, rows)
    return stop, contact.watch, host.time_increment, contact.points
