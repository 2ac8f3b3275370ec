# SPDX-License-Identifier: MIT
"""The standard (implicit) driver: FRIC and FRIC_COEF in increments and iterations."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from usersub.core import lib
from usersub.driver.base import Driver, alone

_OUTPUTS = ("tau", "ddtddg", "ddtddp", "ddtddt", "lm", "dslip", "sed", "sfd")


class StandardResponse(NamedTuple):
    """What one iteration gives; arrays are None where the scene does not want them.

    Attributes:
        tau: friction stress, shape (F, N).
        ddtddg: derivative of stress (first index) by sliding motion (second), shape (F, F, N).
        ddtddp: derivative of stress by pressure, shape (F, N).
        ddtddt: derivative of stress by the two surface temperatures, shape (F, 2, N).
        lm: relative motion, shape (N,): 0 allowed, 1 none, 2 frictionless or open.
        dslip: increment of non-recoverable slip, shape (F, N).
        sed, sfd: elastic energy density and dissipation of the increment, shape (N,).
        pnewdt: smallest suggested over current time increment.
        cut_back: whether a routine asks for a smaller time increment.
    """

    tau: np.ndarray
    ddtddg: np.ndarray | None
    ddtddp: np.ndarray | None
    ddtddt: np.ndarray | None
    lm: np.ndarray
    dslip: np.ndarray
    sed: np.ndarray
    sfd: np.ndarray
    pnewdt: float
    cut_back: bool


class StandardDriver(Driver):
    """FRIC or FRIC_COEF: `begin_increment`, `iterate` as often as needed, `commit` or `cut_back`.

    Every iteration starts from the committed state, which only `commit` changes.
    """

    kind = "standard"
    interfaces = ("fric", "fric_coef")
    _c_call = "usub_iterate"

    @alone
    def begin_increment(
        self,
        time_increment: float,
        *,
        step_time: float | None = None,
        total_time: float | None = None,
        step: int = 1,
        increment: int | None = None,
    ) -> None:
        """Opens an increment; times are those at its end, by default committed time + increment."""
        self._set_time(step, increment, (time_increment, step_time, total_time))
        self._check(lib.usub_begin_increment(self._handle))

    def iterate(self, **arrays: np.ndarray | None) -> StandardResponse:
        """One Newton iteration for all closed points, after binding `arrays`.

        Raises:
            SceneError: an array is missing or holds a value that is refused.
            RoutineError: the routine failed. The driver's state is as before.
        """
        self._enter()
        try:
            if arrays:
                self.bind(**arrays)
            found = self._finish(lib.usub_iterate(self._handle))
            results: dict[str, Any] = {name: self._result(name) for name in _OUTPUTS}
            return StandardResponse(
                **results, pnewdt=lib.usub_pnewdt(self._handle), cut_back=found > 0
            )
        finally:
            self._lock.release()

    @alone
    def commit(self) -> None:
        """Accepts the last iteration: its end values are the start values of the next increment."""
        self._check(lib.usub_commit(self._handle))
        self._clock.accept()

    @alone
    def cut_back(self) -> None:
        """Forgets the increment; everything is as before `begin_increment`."""
        self._check(lib.usub_cut_back(self._handle))
        self._clock.pending = None
