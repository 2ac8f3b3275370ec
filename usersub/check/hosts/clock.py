# SPDX-License-Identifier: MIT
"""Steps, increments and times of a call, whatever the interface calls them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from usersub.check.hosts.log import Call


@dataclass(frozen=True)
class Names:
    """Arguments that hold the clock: numbers and times, an array or scalars."""

    step: str
    increment: str
    step_time: str
    total_time: str
    time_increment: str


_FLAGS = ("jFlags(1)", "jFlags(2)", "rData(1)", "rData(2)", "rData(3)")
_NAMES = {
    "fric": Names("KSTEP", "KINC", "TIME(1)", "TIME(2)", "DTIME"),
    "fric_coef": Names(*_FLAGS),
    "fric_coef_2022": Names("iData(1)", "iData(2)", *_FLAGS[2:]),
    "vfric": Names("kStep", "kInc", "timStep", "timGlb", "dTimCur"),
    "vfriction": Names(*_FLAGS),
    "vfric_coef": Names(*_FLAGS),
}


@dataclass(frozen=True)
class Clock:
    """When a call was: numbers of step and increment, times at the end of the increment."""

    step: int
    increment: int
    step_time: float
    total_time: float
    time_increment: float

    @property
    def number(self) -> tuple[int, int]:
        """Step and increment."""
        return self.step, self.increment

    @property
    def start(self) -> float:
        """Total time at the start of the increment."""
        return self.total_time - self.time_increment


def names(call: Call) -> Names:
    """How the interface of a call names its clock."""
    return _NAMES[call.face.key]


def clock(call: Call) -> Clock | None:
    """The clock of a call, None if part of it could not be read."""
    of = names(call)
    parts = (of.step, of.increment, of.step_time, of.total_time, of.time_increment)
    found = [_element(call, name) for name in parts]
    values = [value for value in found if value is not None]
    if len(values) < len(parts):
        return None
    return Clock(int(values[0]), int(values[1]), values[2], values[3], values[4])


def tolerance(call: Call, clocks: list[Clock]) -> float:
    """What rounding may do to sums of times in the precision of the call."""
    eps = float(np.finfo(np.float32 if call.single else np.float64).eps)
    largest = max(max(abs(c.total_time), abs(c.step_time), abs(c.time_increment)) for c in clocks)
    # A time that is summed over many increments gathers rounding errors.
    return 64 * eps * largest


def _element(call: Call, name: str) -> float | None:
    base, bracket, index = name.partition("(")
    if not bracket:
        return call[base]
    values = call.array(base)
    if values is None:
        return None
    return values.reshape(-1)[int(index.rstrip(")")) - 1].item()
