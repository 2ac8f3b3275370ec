# SPDX-License-Identifier: MIT
"""The clock of a driver: what the host does not say follows from what it said last."""

from __future__ import annotations

import numbers
from typing import Any

import numpy as np

from usersub.errors import SceneError


def int32(name: str, value: int) -> int:
    """`value` as an integer of 4 bytes, or SceneError."""
    whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if whole and -(2**31) <= value < 2**31:
        return int(value)
    raise SceneError(f"{name} = {value!r}; expected an integer of 4 bytes")


def real(name: str, value: float) -> float:
    """`value` as a float, or SceneError; the C core checks whether it is finite."""
    if isinstance(value, numbers.Real) and not isinstance(value, bool):
        return float(value)
    raise SceneError(f"{name} = {value!r}; expected a real number")


class Clock:
    """Step, increment and times; what the host does not give follows from what it gave last."""

    def __init__(self) -> None:
        self.step, self.increment = 1, 0
        self.step_time = self.total_time = 0.0
        self.pending: tuple[int, int, float, float, float] | None = None

    def at(
        self,
        step: int,
        increment: int | None,
        time_increment: float,
        step_time: float | None,
        total_time: float | None,
    ) -> tuple[int, int, float, float, float]:
        """Arguments of `usub_set_time` for an increment that ends at the given times."""
        same = step == self.step
        duration = real("time_increment", time_increment)
        if increment is None:
            increment = self.increment + 1 if same else 1
        if step_time is None:
            step_time = (self.step_time if same else 0.0) + duration
        if total_time is None:
            total_time = self.total_time + duration
        return (
            int32("step", step),
            int32("increment", increment),
            real("step_time", step_time),
            real("total_time", total_time),
            duration,
        )

    def load(self, numbers: Any, times: Any) -> None:
        """Takes over the clock of a loaded state."""
        self.step, self.increment = numbers[0] or 1, numbers[1]
        self.step_time, self.total_time = times[0], times[1]
        self.pending = None

    def accept(self) -> None:
        """Makes the pending increment the last accepted one."""
        if self.pending is not None:
            self.step, self.increment, self.step_time, self.total_time, _ = self.pending
            self.pending = None
