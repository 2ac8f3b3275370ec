# SPDX-License-Identifier: MIT
"""What checked drivers can do besides (scene setting `checked`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from usersub.core import lib
from usersub.driver.alone import alone
from usersub.driver.clock import real
from usersub.driver.observed import Observed, observe
from usersub.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Callable

    from usersub.driver.scene import Scene
    from usersub.routine.routine import Routine


class Checked:
    """Part of every driver."""

    routine: Routine
    scene: Scene
    _handle: Any
    _title: str
    _check: Callable[[int], int]
    _finish: Callable[[int], int]
    _where = ""  # line of the last fault, where the routine's twin has found it
    _time_limit = 2.0
    _tracing = False

    def observed(self) -> Observed:
        """What the last call saw (scene setting `checked`).

        Raises:
            SceneError: the driver is not checked.
        """
        self._need_checked("observed()")
        return observe(self._handle, self.routine, self._where)

    @property
    def time_limit(self) -> float:
        """Seconds that the routine of a checked driver has for one call; 0 means no limit.

        Processor time of the thread; a routine that waits has five times as long. Routines that run
        uncompiled have no limit.
        """
        return self._time_limit

    @time_limit.setter
    @alone
    def time_limit(self, seconds: float) -> None:
        self._need_checked("time_limit")
        self._check(lib.usub_set_time_limit(self._handle, real("time_limit", seconds)))
        self._time_limit = float(seconds)

    @property
    def tracing(self) -> bool:
        """Whether a checked driver finds out which arguments the routine reads and writes."""
        return self._tracing

    @tracing.setter
    @alone
    def tracing(self, on: bool) -> None:
        self._check(lib.usub_trace(self._handle, int(bool(on))))
        self._tracing = bool(on)

    @alone
    def call_empty_block(self) -> None:
        """One call of the routine without any contact point (explicit and coefficient drivers).

        The arrays that a call needs have to be bound. Drivers that are not checked do it too.

        Raises:
            SceneError: a standard driver, or an array is missing.
            RoutineError: the routine failed.
        """
        self._finish(lib.usub_call_empty_block(self._handle))

    def _need_checked(self, what: str) -> None:
        if not self.scene["checked"]:
            raise SceneError(
                f"{self._title}: {what} needs a checked driver; make the scene with checked=1"
            )
