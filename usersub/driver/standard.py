# SPDX-License-Identifier: MIT
"""The standard (implicit) driver: FRIC and FRIC_COEF in increments and iterations."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from usersub.core import ffi, lib, text
from usersub.driver.alone import alone
from usersub.driver.base import Driver
from usersub.driver.clock import real

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


class Symmetry(NamedTuple):
    """What a solver that takes tangents as symmetric would lose of those of an iteration.

    Attributes:
        skew: skew part of the derivative of stress by motion, as a fraction of it, shape (N,).
        pressure: size of the derivative of stress by pressure, shape (N,). Nothing in the tangent
            is symmetric to it: pressure does not depend on the sliding motion.
        unsymmetric: whether any point has more of either than rounding.
        solver_switches: whether the commercial solver is assumed to choose its unsymmetric solver.
        sentence: all this for people, with the largest parts and their points.
    """

    skew: np.ndarray
    pressure: np.ndarray
    unsymmetric: bool
    solver_switches: bool
    sentence: str


class StandardDriver(Driver):
    """FRIC or FRIC_COEF: `begin_increment`, `iterate` as often as needed, `commit` or `cut_back`.

    Every iteration starts from the committed state, which only `commit` changes. Points that stick
    by Lagrange multipliers also know what they did in the last iteration of the increment.
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
        amplitude: float | None = None,
    ) -> None:
        """Opens an increment; times are those at its end, by default committed time + increment.

        Args:
            amplitude: how far friction has changed at the end of the increment, from 0 (as at the
                start of the step) to 1 (as the routine says), where the scene has it `changing`;
                by default 1.

        Raises:
            SceneError: a value out of its range, or an increment is open already.
        """
        self._set_time(step, increment, (time_increment, step_time, total_time))
        if amplitude is not None or self.scene["changing"]:
            by = 1.0 if amplitude is None else real("amplitude", amplitude)
            self._check(lib.usub_set_amplitude(self._handle, by))
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

    @alone
    def symmetry(self) -> Symmetry:
        """What a symmetric solver would lose of the tangents of the last iteration.

        Raises:
            SceneError: the scene has no tangents, or no iteration has succeeded.
        """
        points = np.zeros((2, self.scene["points"]))
        skew, pressure = points
        found = ffi.new("usub_symmetry *")
        buffers = [ffi.cast("double *", ffi.from_buffer(part)) for part in points]
        self._check(lib.usub_find_symmetry(self._handle, *buffers, found))
        return Symmetry(
            skew,
            pressure,
            found.unsymmetric_points > 0,
            bool(found.solver_switches),
            text(found.sentence),
        )
