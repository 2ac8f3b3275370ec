# SPDX-License-Identifier: MIT
"""Cases of FRIC_COEF and VFRIC_COEF through the coefficient driver, without enforcement."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.case import one
from usersub.check.respond.answer import Answer
from usersub.check.respond.run import Run
from usersub.driver.coefficient import CoefficientDriver
from usersub.driver.scene import Scene
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject


#: By routine: whether it sets both coefficients with one direction, too. The routine is kept, so
#: that an address is not used twice.
_BOTH: dict[int, tuple[object, bool]] = {}


def two_coefficients(subject: Subject, directions: int) -> bool:
    """Whether the scene of an FRIC_COEF routine has to be anisotropic.

    With one direction some routines that set both coefficients set one, as the number of directions
    tells them, and some both all the same.
    """
    if not subject.anisotropic or directions == 2:
        return subject.anisotropic
    key = id(subject.routine)
    if key not in _BOTH:
        _BOTH[key] = subject.routine, _both_in_one(subject)
    return _BOTH[key][1]


def _both_in_one(subject: Subject) -> bool:
    case = one((subject.scales.slip,), load=subject.scales.load)
    try:
        CoefficientRun(subject.but(anisotropic=False), case, {}).step(0)
    except Error as error:
        return "'anisotropic' to 1" in str(error)
    return False


class CoefficientRun(Run):
    """The coefficient as a function of slip rate (motion over time), pressure, temperature, ..."""

    driver: CoefficientDriver

    def __init__(self, subject: Subject, case: Case, options: dict[str, Any]) -> None:
        super().__init__(subject, case, options)
        self.standard = subject.interface.name == "fric_coef"
        own: dict[str, Any] = {
            "dimension": case.directions + 1,
            "derivatives": int(self.standard),
        }
        if self.standard:
            own["generation"] = subject.interface.generation
            own["anisotropic"] = int(two_coefficients(subject, case.directions))
        else:
            own["states"] = 0
        assert subject.routine is not None
        self.driver = CoefficientDriver(subject.routine, Scene(**self.settings(**own)))
        self._slip = np.zeros((2, case.points))
        self._path = np.zeros(case.points)
        self._initial_state()

    def step(self, index: int) -> Answer:
        step, driver = self.case.steps[index], self.driver
        motion = np.zeros((2, self.case.points))
        motion[: self.case.directions] = np.array(step.motion, dtype=float).T
        length = np.hypot(*motion)
        rate, size = (
            (motion / step.dt, length / step.dt) if step.dt > 0 else (0 * motion, 0 * length)
        )
        self._slip, self._path = self._slip + motion, self._path + length
        around = self._surroundings(step)
        arrays = {"slip_rate": size, "pressure": np.array(step.load, dtype=float)}
        data = np.array([size, *rate, self._path, *self._slip])
        if "slip_data" in driver.layout.ports and self.standard:
            arrays["slip_data"] = data
        for name in ("temperature", "field"):
            if f"{name}_main" in around:
                pair = around[f"{name}_secondary"], around[f"{name}_main"]
                arrays[name] = 0.5 * pair[0] + 0.5 * pair[1]
        coefficient = driver.evaluate(
            time_increment=step.dt,
            step=self.step_number(index),
            **self._put(**{k: v for k, v in arrays.items() if k in driver.layout.ports}),
        )
        return Answer(
            coefficient=self._back(coefficient),
            second=self._own("second_coefficient"),
            derivative=self._own("derivative") if self.standard else None,
            state=self._own("state") if driver.scene["states"] else None,
        )

    def load(self, saved: bytes, step: int) -> None:
        super().load(saved, step)
        for done in self.case.steps[:step]:  # the host's own memory of a driver without one
            motion = np.zeros((2, self.case.points))
            motion[: self.case.directions] = np.array(done.motion, dtype=float).T
            self._slip, self._path = self._slip + motion, self._path + np.hypot(*motion)

    def _own(self, name: str) -> np.ndarray | None:
        kept = name in self.driver.layout.ports and self.driver.keeps(name)
        return self._back(self.driver.array(name)) if kept else None
