# SPDX-License-Identifier: MIT
"""What a plan saves: time with it and with everything passed, measured in turns."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from usersub.core import ffi, lib

if TYPE_CHECKING:
    from usersub.driver.base import Driver

#: Rounds, and seconds of each call in a round.
ROUNDS, SECONDS = 15, 2e-3

#: The clock: processor time of the thread, which others on the machine do not lengthen.
clock: Callable[[], float] = time.thread_time


def in_turns(
    calls: Mapping[str, Callable[[], object]], rounds: int = ROUNDS, seconds: float = SECONDS
) -> dict[str, float]:
    """Median seconds of one call of each, after one that does not count.

    All are called in every round, so that a machine that is busy for a while slows all of them.
    """
    times = {
        name: max(1, round(seconds / max(_once(call, 1), 1e-9))) for name, call in calls.items()
    }
    found: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            found[name].append(_once(call, times[name]))
    return {name: statistics.median(each) for name, each in found.items()}


def _once(call: Callable[[], object], times: int) -> float:
    start = clock()
    for _ in range(times):
        call()
    return (clock() - start) / times


def prepared(driver: Driver, time_increment: float = 1e-3) -> Callable[[], object]:
    """One call of the driver, made once already, as a function without arguments.

    A standard driver repeats the first iteration of an increment.
    """
    if driver.kind == "standard":
        driver.begin_increment(time_increment)  # type: ignore[attr-defined]
        driver.iterate()  # type: ignore[attr-defined]
    elif driver.kind == "explicit":
        driver.step(time_increment)  # type: ignore[attr-defined]
    else:
        driver.evaluate(time_increment=time_increment)  # type: ignore[attr-defined]
    return driver.prepare()


def twin(driver: Driver, everything: bool) -> Driver:
    """A driver of the same routine in the same scene, with the arrays and the state of now.

    It reads the host's arrays and writes to memory of its own.
    """
    scene = driver.scene.replace(pass_everything=int(everything), checked=0)
    made = type(driver)(driver.routine, scene)
    made.points = driver.points
    arrays: dict[str, np.ndarray] = {}
    for name, array in driver._bound.items():
        role = driver.layout.ports[name].role
        if role != "out":
            arrays[name] = array if role == "in" else np.zeros_like(array, order="F")
    made.bind(**arrays)
    made.load_state(driver.save_state())
    return made


def measure(driver: Driver, rounds: int = ROUNDS) -> tuple[float, float]:
    """Nanoseconds per contact point with the plan, and with everything passed.

    The driver itself is not called.

    Raises:
        SceneError: an array that the driver needs is not bound.
    """
    numbers, times = ffi.new("int32_t[2]"), ffi.new("double[3]")
    driver._check(lib.usub_get_time(driver._handle, numbers, times))
    increment = times[2] if times[2] > 0.0 else 1e-3
    twins = {str(everything): twin(driver, everything) for everything in (False, True)}
    found = in_turns({name: prepared(made, increment) for name, made in twins.items()}, rounds)
    points = max(driver.points, 1)
    return found["False"] / points * 1e9, found["True"] / points * 1e9
