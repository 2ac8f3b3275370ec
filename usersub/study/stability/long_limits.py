# SPDX-License-Identifier: MIT
"""Holds and cycles of very many increments: creep and energy drift."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from usersub.study.stability.cell import Limit
from usersub.study.stability.explicit_limits import Block

#: Increments of a full and of a quick run.
MANY, FEW = 10_000_000, 20_000

#: Law, properties, states, settings of the scene, interface; slip of a cycle that stays in stick.
_EXPLICIT: tuple[tuple[str, tuple[float, ...], int, dict[str, Any], str, float], ...] = (
    ("coulomb", (0.3,), 0, {"enforcement": "penalty", "stick_slope": 300.0}, "vfric_coef", 0.03),
    ("softened", (0.3, 1e5), 3, {}, "vfriction", 1e-4),
    ("iwan", (0.3, 1.0, 1e5, 1.0), 3, {}, "vfriction", 1e-4),
    ("elasto_plastic", (0.3, 0.3, 0.01, 2.0, 1e5, 0.0, 0.0, 0.9), 3, {}, "vfriction", 1e-4),
)  # fmt: skip


def explicit_cycles(count: int, precision: str) -> Iterator[Limit]:
    """Back and forth in stick: what is left of the force, and the energy that was made."""
    for law, props, states, settings, interface, slip in _EXPLICIT:
        block = Block(law, props, interface, precision, states, load=100.0, **settings)
        block.force(slip, 1.0)
        first = block.force(-slip, 1.0)
        peak = abs(block.force(slip, 1.0))
        last = block.force(-slip, 1.0)
        call, motion, force = block.driver.prepare(), block.slip, block.driver.array("force")
        work = 0.0
        for i in range(count):
            motion[0, 0] = slip if i % 2 == 0 else -slip
            call()
            last = float(force[0, 0])
        work = _cycle_work(block, slip)
        name = f"driver: penalty, {law}" if settings else law
        yield Limit(
            f"creep of {count:.0e} cycles in stick".replace("e+0", "e"), name, interface, "c",
            precision, abs(last - first) / peak, 0.0, "of the amplitude",
            "change of the force at the end of a closed cycle; theory: none",
        )  # fmt: skip
        yield Limit(
            f"energy of a cycle after {count:.0e}".replace("e+0", "e"), name, interface, "c",
            precision, work / (peak * slip), 0.0, "of the work",
            "work of a closed cycle in stick, by the trapezoidal rule; theory: none",
        )  # fmt: skip


def _cycle_work(block: Block, slip: float) -> float:
    """Work of two cycles."""
    forces = [block.force(s, 1.0) for s in (slip, -slip, slip, -slip)]
    before = forces[-1]
    work = 0.0
    for force, motion in zip(forces, (slip, -slip, slip, -slip), strict=True):
        work -= 0.5 * (before + force) * motion
        before = force
    return work


def standard_holds(count: int) -> Iterator[Limit]:
    """Standing still after sliding, with and without ageing; raw calls of the core."""
    from usersub import Scene, StandardDriver, laws
    from usersub.core import lib

    cases: tuple[tuple[str, str, tuple[float, ...], int], ...] = (
        ("coulomb", "fric_coef", (0.3,), 0),
        ("dahl", "fric", (0.3, 1e5), 2),
        ("lugre", "fric", (0.4, 0.3, 0.01, 2.0, 1e5, 0.0, 0.0), 2),
        ("rate_state_ageing", "fric_coef", (0.6, 0.005, 0.01, 1e-6, 1e-5, 10.0, 1e-12), 1),
    )
    for law, interface, props, states in cases:
        driver = StandardDriver(
            laws.routine(law, interface, "c"),
            Scene(points=1, dimension=3, props=props, states=states, characteristic_length=2e-3),
            reuse=True,
        )
        motion = np.zeros((2, 1), order="F")
        driver.bind(slip_increment=motion, pressure=np.full(1, 100.0))
        for slip in (0.0, 1e-2, 0.0):
            motion[0, 0] = slip
            driver.begin_increment(1e-3)
            response = driver.iterate()
            driver.commit()
        start, handle = float(response.tau[0, 0]), driver._handle
        for _ in range(count):
            if lib.usub_begin_increment(handle) or lib.usub_iterate(handle):
                break
            lib.usub_commit(handle)
        end = float(driver.array("tau")[0, 0])
        expected = 0.0
        if law == "rate_state_ageing":  # its elastic slip is held, its strength grows
            theta = float(driver.state["state"][-1, 0])
            held = (1e-3 * (count + 1)) + props[4] / 1.0 * 0.0
            yield Limit(
                f"age after a hold of {count:.0e}".replace("e+0", "e"), law, interface, "c",
                "double", theta, held + _aged_at_start(props), "time",
                "state variable after standing still; theory: as old as the hold",
            )  # fmt: skip
            continue
        yield Limit(
            f"creep of {count:.0e} increments of hold".replace("e+0", "e"), law, interface, "c",
            "double", abs(end - start) / abs(start), expected, "of the stress",
            "change of the stress while nothing moves; theory: none",
        )  # fmt: skip


def _aged_at_start(props: tuple[float, ...]) -> float:
    """Age after the slide of 1e-2 less the elastic slip, in which the old contacts are renewed."""
    dt, slip = 1e-3, 1e-2 - 1e-5
    return props[4] * dt / slip
