# SPDX-License-Identifier: MIT
"""The coefficient driver: FRIC_COEF and VFRIC_COEF without enforcement."""

from __future__ import annotations

import numpy as np

from usersub.core import lib
from usersub.driver.base import Driver


class CoefficientDriver(Driver):
    """FRIC_COEF or VFRIC_COEF as a function from slip rate, pressure, ... to the coefficient."""

    kind = "coefficient"
    interfaces = ("fric_coef", "vfric_coef")
    _c_call = "usub_evaluate"

    def evaluate(
        self,
        *,
        time_increment: float | None = None,
        step_time: float | None = None,
        total_time: float | None = None,
        step: int = 1,
        increment: int | None = None,
        **arrays: np.ndarray | None,
    ) -> np.ndarray:
        """The friction coefficient of every point, shape (N,), after binding `arrays`.

        The second coefficient and the derivatives are in `array("second_coefficient")` and
        `array("derivative")` where the scene wants them. Without a time increment the clock stands.

        Raises:
            SceneError: an array is missing or holds a value that is refused.
            RoutineError: the routine failed. The driver's state is as before.
        """
        self._enter()
        try:
            if arrays:
                self.bind(**arrays)
            if time_increment is not None:
                self._set_time(step, increment, (time_increment, step_time, total_time))
            self._finish(lib.usub_evaluate(self._handle))
            self._clock.accept()
            return self._result("coefficient")  # type: ignore[return-value]
        finally:
            self._lock.release()
