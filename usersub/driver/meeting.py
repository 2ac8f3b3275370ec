# SPDX-License-Identifier: MIT
"""Two threads in one routine, right behind a write to data that it keeps."""

from __future__ import annotations

from dataclasses import dataclass

from usersub.core import ffi, lib, text
from usersub.driver import status
from usersub.driver.base import Driver
from usersub.driver.observed import place_of
from usersub.errors import Error


@dataclass(frozen=True)
class Meeting:
    """How two calls met.

    Attributes:
        met: whether the first call made that many writes to data that the library keeps; else the
            second call came after it.
        where: "file:line" of the write, or "".
        variable: symbol of what was written, as in the library (that of COMMON /WORK/ is
            ``work_``, that of a local variable with SAVE ``count.0``), or "".
        failures: what the two calls would have raised, or None.
    """

    met: bool
    where: str
    variable: str
    failures: tuple[Error | None, Error | None]


def meet(one: Driver, two: Driver, turn: int = 1) -> Meeting:
    """The next call of two drivers of one routine, from two threads.

    All of the second call happens right behind the write number `turn` of the first one to data
    that the library of the routine keeps (COMMON, SAVE, static), which is where it hurts most. As
    with `prepare`, the calls are `iterate`, `step` or `evaluate` with what is bound and set; the
    answers are in `array(name)` of the drivers. Answers that differ from those of one call after
    the other are due to these data, whatever the machine is busy with. A second call that waits for
    a lock of the first is not waited for.

    Args:
        one: driver without threads, not checked.
        two: another one of the same routine.
        turn: number of the write, from 1.

    Raises:
        SceneError: the drivers are checked or have threads, the routine is in no library that keeps
            data, or the system is not Linux on x86-64.
    """
    one._enter()
    try:
        two._enter()
        try:
            return _meet(one, two, turn)
        finally:
            two._lock.release()
    finally:
        one._lock.release()


def _meet(one: Driver, two: Driver, turn: int) -> Meeting:
    found = ffi.new("usub_meeting *")
    one._check(lib.usub_meet(one._handle, two._handle, turn, found))
    failures = (_failure(one, found.status_one), _failure(two, found.status_two))
    where, variable = "", ""
    if found.met:
        from usersub.routine import places

        where = place_of(found.place, one.routine)
        code = places.locate(one._entry.address)
        variable = places.variable(code.library, found.address) if code else ""
    for driver in (one, two):
        if driver.routine.after_call is not None:
            driver.routine.after_call()
    return Meeting(bool(found.met), where, variable, failures)


def _failure(driver: Driver, found: int) -> Error | None:
    if found >= 0:
        return None
    point = lib.usub_failed_point(driver._handle)
    return status.exception(found, text(lib.usub_message(driver._handle)), point)
