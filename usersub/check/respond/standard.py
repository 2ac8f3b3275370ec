# SPDX-License-Identifier: MIT
"""Cases of FRIC, and of FRIC_COEF with enforcement, through the standard driver."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.respond.answer import Answer
from usersub.check.respond.coefficient import two_coefficients
from usersub.check.respond.run import Run
from usersub.driver.scene import Scene
from usersub.driver.standard import StandardDriver, StandardResponse

if TYPE_CHECKING:
    from usersub.check.case import Case
    from usersub.check.subject import Subject
    from usersub.driver.observed import Observed


class StandardRun(Run):
    """Increments with iterations; all points count as closed, whatever their pressure."""

    driver: StandardDriver
    _seen: Observed | None = None

    def __init__(self, subject: Subject, case: Case, options: dict[str, Any]) -> None:
        super().__init__(subject, case, options)
        directions = case.directions
        own: dict[str, Any] = {
            "dimension": directions + 1,
            "friction_directions": directions,
            "temperature_tangent": int(subject.temperatures),
            "characteristic_length": 1.0,
        }
        coefficient = subject.interface.name == "fric_coef"
        if coefficient:
            own["elastic_slip"] = subject.scales.stick or 1e-2 * subject.scales.slip
            own["generation"] = subject.interface.generation
            own["anisotropic"] = int(two_coefficients(subject, directions))
        assert subject.routine is not None
        self.driver = StandardDriver(subject.routine, Scene(**self.settings(**own)))
        points = np.arange(case.points)
        places = {
            "coord": np.array([points + 0.1 * (d + 1) for d in range(directions + 1)]),
            "coord_main": np.array([points - 0.1 * (d + 1) for d in range(directions + 1)]),
            "contact_stiffness": 100.0 * subject.scales.load + points,
        }
        fixed = {} if coefficient else self._put(**places)
        closed = np.ones(case.points, dtype=np.int32)
        node = np.asfortranarray(self.order + 11, dtype=np.int32)
        self.driver.bind(**fixed, closed=closed, node=node)
        self._initial_state()

    def step(self, index: int) -> Answer:
        step = self.case.steps[index]
        driver, turn = self.driver, self._matrix()
        motion = turn @ np.array(step.motion, dtype=float).T
        arrays: dict[str, np.ndarray] = {
            "slip_increment": motion,
            "pressure": np.array(step.load, dtype=float),
            **self._surroundings(step),
        }
        if step.multiplier is not None:
            arrays["multiplier"] = turn @ np.array(step.multiplier, dtype=float).T
        self._seen = None
        driver.begin_increment(step.dt, step=self.step_number(index))
        try:
            driver.bind(**self._put(**arrays))
            for _ in range(max(step.iterations, 1)):
                response = driver.iterate()
            if not step.cut_back:
                driver.commit()
        except BaseException:
            if driver.scene["checked"]:
                self._seen = driver.observed()  # the driver forgets with the increment
            driver.cut_back()
            raise
        if step.cut_back:
            driver.cut_back()
        return self._answer(response, turn)

    def ready(self, index: int) -> None:
        self.step(index)
        self.driver.begin_increment(self.case.steps[index].dt, step=self.step_number(index))

    def observed(self) -> Observed:
        return self._seen or super().observed()

    def _matrix(self) -> np.ndarray:
        return self._turn() if self.case.directions == 2 else np.eye(1)

    def _answer(self, response: StandardResponse, turn: np.ndarray) -> Answer:
        state = self.driver.state["state"] if self.subject.states else None
        tangent, by_temperature = self._back(response.ddtddg), self._back(response.ddtddt)
        by_pressure = self._back(response.ddtddp)
        if tangent is not None:
            tangent = np.einsum("ai,abn,bj->ijn", turn, tangent, turn)
        if by_temperature is not None:
            by_temperature = np.einsum("ai,abn->ibn", turn, by_temperature)
        return Answer(
            friction=turn.T @ self._back(response.tau),
            tangent=tangent,
            by_pressure=None if by_pressure is None else turn.T @ by_pressure,
            by_temperature=by_temperature,
            lm=self._back(response.lm),
            dslip=turn.T @ self._back(response.dslip),
            sed=self._back(response.sed),
            sfd=self._back(response.sfd),
            coefficient=self._coefficient(),
            pnewdt=response.pnewdt,
            state=self._back(state),
        )

    def _coefficient(self) -> np.ndarray | None:
        if self.subject.interface.name != "fric_coef":
            return None
        return self._back(self.driver.array("coefficient")[0])
