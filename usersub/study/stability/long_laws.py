# SPDX-License-Identifier: MIT
"""Cycles and holds of very many increments for every shipped law."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from usersub.study.stability.cell import Limit
from usersub.study.stability.explicit_limits import Block
from usersub.study.stability.long_limits import FEW, MANY, explicit_cycles, standard_holds
from usersub.study.stability.subjects import Subject, of_law

#: Increments in which a law comes to its cycle, or to rest.
SETTLED = 2000


def _laws(interfaces: tuple[str, ...]) -> Iterator[Subject]:
    """Every law behind the first of the interfaces that carries it, in C."""
    from usersub import laws

    for name in laws.LAWS:
        carried = [i for i in interfaces if i in laws.law(name).interfaces]
        if carried:
            yield of_law(name, carried[0], "c", "double")


def _words(count: int) -> str:
    return f"{count:.0e}".replace("e+0", "e")


def cycles(count: int, part: int, parts: int) -> Iterator[Limit]:
    """Back and forth by the ordinary slip of each law: what the force of a cycle changes by."""
    for number, subject in enumerate(_laws(("vfriction",))):
        if number % parts != part:
            continue
        block = Block(
            subject.law, subject.props, "vfriction", states=subject.states,
            load=subject.scales.load, warm=subject.scales.temperature, temperatures=1,
        )  # fmt: skip
        slip, dt = 0.8 * subject.scales.slip, subject.scales.time
        peak = 0.0
        for i in range(SETTLED):
            first = block.force(slip if i % 2 == 0 else -slip, dt)
            peak = max(peak, abs(first))
        call, motion, force = block.driver.prepare(), block.slip, block.driver.array("force")
        for i in range(count):
            motion[0, 0] = slip if i % 2 == 0 else -slip
            call()
        last = float(force[0, 0])
        yield Limit(
            f"change of the force in {_words(count)} cycles", subject.law, "vfriction", "c",
            "double", abs(last - first) / (peak or 1.0), 0.0, "of the force",
            "the law's ordinary slip to and fro, once it has settled; theory: none",
        )  # fmt: skip


def holds(count: int, part: int, parts: int) -> Iterator[Limit]:
    """Standing still after sliding: what the stress changes by, once it has relaxed."""
    from usersub import Scene, StandardDriver
    from usersub.core import lib

    for number, subject in enumerate(_laws(("fric", "fric_coef"))):
        if number % parts != part:
            continue
        scales = subject.scales
        scene = Scene(
            points=1, dimension=3, props=subject.props, states=subject.states, temperatures=1,
            characteristic_length=2.0 * scales.slip, **subject.settings,
        )  # fmt: skip
        driver = StandardDriver(subject.make(), scene, reuse=True)
        motion = np.zeros((2, 1), order="F")
        known: dict[str, Any] = {"slip_increment": motion, "pressure": np.full(1, scales.load)}
        for side in ("temperature_secondary", "temperature_main"):
            if side in driver.layout.ports:
                known[side] = np.full(1, scales.temperature)
        driver.bind(**known)
        start = peak = 0.0
        for i in range(SETTLED):
            motion[0, 0] = scales.slip if i == 1 else 0.0
            driver.begin_increment(0.1 * scales.time)
            start = float(driver.iterate().tau[0, 0])
            driver.commit()
            peak = max(peak, abs(start))
        handle = driver._handle
        for _ in range(count):
            if lib.usub_begin_increment(handle) or lib.usub_iterate(handle):
                break
            lib.usub_commit(handle)
        change = abs(float(driver.array("tau")[0, 0]) - start) / (peak or 1.0)
        ages = subject.law.startswith("rate_state")
        yield Limit(
            f"creep of {_words(count)} increments of hold", subject.law, subject.interface, "c",
            "double", change, None if ages else 0.0, "of the stress",
            "the strength grows with age" if ages
            else "change of the stress while nothing moves, once it has relaxed; theory: none",
        )  # fmt: skip


def _count(quick: bool) -> int:
    return FEW if quick else MANY


def double_cycles(quick: bool) -> Iterator[Limit]:
    """Cycles in stick, double precision."""
    yield from explicit_cycles(_count(quick), "double")


def single_cycles(quick: bool) -> Iterator[Limit]:
    """Cycles in stick, single precision."""
    yield from explicit_cycles(_count(quick), "single")


def core_holds(quick: bool) -> Iterator[Limit]:
    """Holds with a theory of their own."""
    yield from standard_holds(_count(quick))


def cycles_one(quick: bool) -> Iterator[Limit]:
    """Cycles of every other law."""
    yield from cycles(_count(quick), 0, 2)


def cycles_two(quick: bool) -> Iterator[Limit]:
    """Cycles of the others."""
    yield from cycles(_count(quick), 1, 2)


def holds_one(quick: bool) -> Iterator[Limit]:
    """Holds of every other law."""
    yield from holds(_count(quick), 0, 2)


def holds_two(quick: bool) -> Iterator[Limit]:
    """Holds of the others."""
    yield from holds(_count(quick), 1, 2)
