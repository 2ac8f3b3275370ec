# SPDX-License-Identifier: MIT
"""Runs a history through VFRIC, VFRICTION or VFRIC_COEF: one step for each increment.

If the scene's `enforcement` is kinematic or penalty, the driver enforces sticking; kinematic takes
the history's `mass`. Otherwise the stick force, which a host gets from its own contact algorithm,
follows one of four rules:

* the column `stick_force`;
* `stick_stiffness` k: the elastic trial force |F_previous - k ds| of penalty contact;
* `mass` m: the force m |ds| / dt^2 that would have prevented the slip, as in kinematic contact;
* otherwise the history's slip is taken as given, as by a body of unlimited mass: the stick force is
  `UNLIMITED` where a point moves and zero where it rests.
"""

from __future__ import annotations

from collections import defaultdict
from typing import Any

import numpy as np

from usersub.errors import SceneError
from usersub.scenefile.geometry import Bound, FlatModel, Progress
from usersub.scenefile.history import History
from usersub.scenefile.interpolate import Row, at
from usersub.scenefile.results import HistoryResult

#: Stick force that limits nothing; its square is still finite in single precision.
UNLIMITED = 1.0e18


def run(
    driver, settings: dict, history: History, result: HistoryResult, progress: Progress
) -> None:
    """Takes every increment of `history` with `driver` and fills `result`.

    Raises:
        SceneError: the scene gives VFRIC_COEF state variables.
        RoutineError: the routine fails.
    """
    if result.interface == "vfric_coef" and settings.get("states", 0):
        raise SceneError(
            f"scene setting 'states' = {settings['states']}; expected 0, as VFRIC_COEF has no "
            "state variables"
        )
    _Run(driver, settings, history, result, progress).all()


class _Run:
    def __init__(self, driver, settings, history, result, progress) -> None:
        self.driver, self.history, self.result, self.progress = driver, history, result, progress
        self.bound = Bound(driver, result.interface, result.precision)
        self.dimension = settings["dimension"]
        self.states = settings.get("states", 0)
        reach = float(np.abs(history.slip).max())
        self.model = FlatModel(result.interface, settings, reach)
        self.force = np.zeros((self.dimension, history.points))
        self.dissipation = np.zeros(history.points)
        self.kept: dict[str, list[Any]] = defaultdict(list)
        self.increment = 0

    def all(self) -> None:
        """Every row, then the columns."""
        history = self.history
        rows = len(history.time) - 1
        last = at(history, 0, 0.0)
        self.bound.put(self.model.fixed(last.area))
        for row in range(rows):
            for part in range(history.substeps):
                now = at(history, row, (part + 1) / history.substeps)
                self._take(last, now)
                last = now
            self.progress(row + 1, rows)
        self.result.columns = {k: np.array(v) for k, v in self.kept.items()}

    def _take(self, last: Row, now: Row) -> None:
        step = now.time - last.time
        slip = np.zeros((self.dimension, self.history.points))
        slip[: self.history.directions] = (now.slip - last.slip).T
        velocity = slip[: self.history.directions].T / step
        values = {"slip_increment": slip, "normal_force": now.normal_force}
        enforced = "condition" in self.driver.state
        if not enforced:
            values["stick_force"] = self._stick_force(now, slip, step)
        elif self.history.mass is not None:
            values["mass"] = np.full(self.history.points, self.history.mass)
        values |= self.model.moving(now.slip, velocity)
        values["area"] = self.model.fixed(now.area)["area"]
        if now.temperature is not None:
            values["temperature_secondary"] = now.temperature[0]
            values["temperature_main"] = self.model.per_main(now.temperature[1])
        if now.fields is not None:
            values["field_secondary"] = now.fields[0].T
            values["field_main"] = self.model.per_main(now.fields[1].T)
        self.bound.put(values)
        self.increment += 1
        answer = self.driver.step(
            step,
            step_time=now.time - self.history.time[0],
            total_time=now.time,
            increment=self.increment,
        )
        self.force = np.array(answer.force, dtype=float)
        self.dissipation = self.dissipation - np.sum(self.force * slip, axis=0)
        self._keep(now, answer)

    def _stick_force(self, now: Row, slip: np.ndarray, step: float) -> np.ndarray:
        history = self.history
        if now.stick_force is not None:
            return now.stick_force
        if history.stick_stiffness is not None:
            return np.linalg.norm(self.force - history.stick_stiffness * slip, axis=0)
        length = np.linalg.norm(slip, axis=0)
        if history.mass is not None:
            return history.mass * length / step**2
        return np.where(length > 0.0, UNLIMITED, 0.0)

    def _keep(self, now: Row, answer) -> None:
        kept = self.kept
        force = self.force[: self.history.directions].T
        kept["time"].append(now.time)
        kept["slip"].append(now.slip)
        kept["pressure"].append(now.pressure)
        # Friction stress on the main surface: positive along the slip, as in the implicit solver.
        kept["tau"].append(-force / now.area[:, None])
        kept["force"].append(force)
        kept["normal_force"].append(now.normal_force)
        if self.driver.keeps("stick_force"):
            kept["stick_force"].append(np.array(self.driver.array("stick_force"), dtype=float))
        size = np.linalg.norm(force, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            kept["mobilised"].append(np.where(now.normal_force > 0.0, size / now.normal_force, 0.0))
        if self.result.interface == "vfric_coef":
            kept["coefficient"].append(np.array(answer.coefficient, dtype=float))
        kept["dissipation"].append(self.dissipation)
        if self.states:
            kept["state"].append(self._state())

    def _state(self) -> np.ndarray:
        """State variables as `[point, variable]`; those of an edge's nodes in a row."""
        state = np.array(self.driver.state["state"], dtype=float)
        state = state.reshape(-1, state.shape[-1], order="F")
        return state[:, : self.history.points].T
