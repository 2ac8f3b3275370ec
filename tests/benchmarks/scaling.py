# SPDX-License-Identifier: MIT
"""Cost against the number of contact points and of threads, memory a point, and a line beyond."""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import usersub
from tests.benchmarks import coefficient, fric, laws, vfriction
from tests.benchmarks.timing import once
from usersub.study import allocated

SIZES = (1, 10, 100, 1_000, 10_000, 100_000, 1_000_000)
LARGEST = 10_000_000
#: Points of the measurements of threads and memory.
MANY = 1_000_000
MACHINES = (1, 10, 100, 1000)
POINTS_BEYOND = 1_000_000_000


@dataclass(frozen=True)
class Curve:
    """Seconds of a call by number of points.

    Attributes:
        work: interface, law, language.
        seconds: median of one call, by number of points.
        driver_bytes: memory of the driver a point.
        host_bytes: memory of the host's arrays a point.
    """

    work: str
    seconds: dict[int, float]
    driver_bytes: float
    host_bytes: float

    @property
    def ns(self) -> float:
        """Nanoseconds a point where there are most."""
        points = max(self.seconds)
        return self.seconds[points] / points * 1e9


def _coefficient(points: int) -> tuple:
    driver, call = coefficient.prepared(laws.vectorised, points)
    return driver, call


def _fric(points: int) -> tuple:
    driver, call = fric.prepared(usersub.fric(fric.law), points)
    return driver, call


def _vfriction(points: int) -> tuple:
    driver, call, _ = vfriction.prepared(usersub.vfriction(vfriction.law), points)
    return driver, call


#: What is measured: words, driver and prepared call, how many points at most.
WORKS: tuple[tuple[str, Callable[[int], tuple], int], ...] = (
    ("VFRIC_COEF, exponential decay, vector_math", _coefficient, LARGEST),
    ("VFRICTION, axes, Coulomb, nodes", _vfriction, MANY),
    ("FRIC, Coulomb with tangent", _fric, MANY),
)


def median(call: Callable, rounds: int = 7) -> float:
    """Median seconds of processor time of a call, in rounds of a few milliseconds."""

    def repeat(times: int) -> None:
        for _ in range(times):
            call()

    repeat(2)
    times = max(1, int(0.01 / once(repeat, 2)))
    return statistics.median(once(repeat, times) for _ in range(rounds))


def curves() -> list[Curve]:
    """Each work for each number of points."""
    found = []
    for work, make, most in WORKS:
        seconds = {}
        for points in (*SIZES, LARGEST):
            if points > most:
                continue
            _, call = make(points)
            seconds[points] = median(call, 3 if points > 100_000 else 7)
        (driver, _), grown = allocated.growth(lambda make=make: make(100_000))
        host = sum(a.nbytes for a in driver._bound.values()) / 100_000
        found.append(Curve(work, seconds, grown / 100_000 - host, host))
    return found


def threads(folder: Path) -> dict[str, dict[int, float]]:
    """Wall time of a call for a million points by number of threads."""
    found: dict[str, dict[int, float]] = {}
    counts = range(1, (os.cpu_count() or 1) + 1)
    rate = coefficient.slip_rates(MANY)
    for work, routine in (("scalar exp", laws.python), ("vector_math", laws.vectorised)):
        made = {}
        for count in counts:
            scene = usersub.Scene(points=MANY, props=laws.PROPS, threads=count)
            driver = usersub.CoefficientDriver(routine, scene)
            driver.evaluate(slip_rate=rate, pressure=np.ones(MANY))
            made[count] = (driver, driver.prepare())
        rounds: dict[int, list[float]] = {count: [] for count in counts}
        for _ in range(9):
            for count, (_, call) in made.items():
                start = time.perf_counter()
                call()
                rounds[count].append(time.perf_counter() - start)
        found[work] = {count: statistics.median(r) for count, r in rounds.items()}
    return found


def size_table(found: list[Curve]) -> str:
    """Nanoseconds a point by number of points."""
    lines = [
        "| points | " + " | ".join(c.work for c in found) + " |",
        "| ---: |" + " ---: |" * len(found),
    ]
    for points in (*SIZES, LARGEST):
        cells = [
            f"{c.seconds[points] / points * 1e9:.3g}" if points in c.seconds else "not measured"
            for c in found
        ]
        lines.append(f"| {points} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def thread_table(found: dict[str, dict[int, float]]) -> str:
    """Wall time and speed-up by number of threads."""
    lines = ["| threads | " + " | ".join(f"{w}, ms | speed-up" for w in found) + " |"]
    lines.append("| ---: |" + " ---: | ---: |" * len(found))
    for count in next(iter(found.values())):
        cells = [f"{s[count] * 1e3:.3g} | {s[1] / s[count]:.2f}" for s in found.values()]
        lines.append(f"| {count} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def memory_table(found: list[Curve]) -> str:
    """Bytes a point."""
    lines = ["| work | arrays of the host, bytes | driver, bytes |", "| --- | ---: | ---: |"]
    lines += [f"| {c.work} | {c.host_bytes:.0f} | {c.driver_bytes:.0f} |" for c in found]
    return "\n".join(lines)


def beyond_table(found: list[Curve], cores: int) -> str:
    """A billion points on several machines."""
    lines = [
        "| work | machines | points a machine | seconds an increment | memory a machine, GB |",
        "| --- | ---: | ---: | ---: | ---: |",
    ]
    for curve in found:
        for machines in MACHINES:
            points = POINTS_BEYOND / machines
            seconds = points * curve.ns * 1e-9 / cores
            gigabytes = points * (curve.host_bytes + curve.driver_bytes) / 1e9
            lines.append(
                f"| {curve.work} | {machines} | {points:.0e} | {seconds:.2g} | {gigabytes:.2g} |"
            )
    return "\n".join(lines)
