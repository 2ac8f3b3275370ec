# SPDX-License-Identifier: MIT
"""Runs a history through FRIC or FRIC_COEF: increments, iterations, cut-backs."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

import numpy as np

from usersub.errors import RoutineError
from usersub.scenefile.geometry import Bound, Progress
from usersub.scenefile.history import History
from usersub.scenefile.interpolate import Row, at
from usersub.scenefile.results import HistoryResult

_OUTPUTS = ("tau", "lm", "dslip", "sed", "sfd")


def run(
    driver, settings: dict, history: History, result: HistoryResult, progress: Progress
) -> None:
    """Takes every increment of `history` with `driver` and fills `result`.

    An increment whose iteration sets PNEWDT below 1 is cut back and halved, `history.cut_backs`
    times at most. An increment is iterated until LM is what it was on entry.

    Raises:
        RoutineError: the routine fails, or still asks for a cut-back when the limit is reached.
    """
    _Run(driver, settings, history, result, progress).all()


class _Run:
    def __init__(self, driver, settings, history, result, progress) -> None:
        self.driver, self.history, self.result, self.progress = driver, history, result, progress
        self.bound = Bound(driver, result.interface, result.precision)
        self.dimension = settings["dimension"]
        self.states = settings.get("states", 0)
        self.kept: dict[str, list[Any]] = defaultdict(list)
        self.increment = 0
        self.rough = self.unsettled = 0

    def all(self) -> None:
        """Every row, then the columns."""
        self._put(at(self.history, 0, 0.0))
        self._start()
        rows = len(self.history.time) - 1
        for row in range(rows):
            for part in range(self.history.substeps):
                self._take(row, part / self.history.substeps, (part + 1) / self.history.substeps, 0)
            self.progress(row + 1, rows)
        self.result.columns = {k: np.array(v) for k, v in self.kept.items()}
        if self.unsettled:
            self.result.notes.append(
                f"in {self.unsettled} increments LM still changed after {self.history.iterations} "
                "iterations"
            )
        if self.rough:
            self.result.notes.append(
                f"{self.rough} times a point asked for no relative motion (LM = 1) while the "
                "history prescribes slip: its friction stress is that of a constraint, not known "
                "here"
            )

    def _start(self) -> None:
        """Points with pressure in the first row are closed at the start, slipping."""
        pressure = self.history.pressure[0]
        self.driver.state["condition"][...] = np.where(pressure > 0.0, 0, 2)
        self.driver.state["committed_pressure"][...] = pressure

    def _take(self, row: int, begin: float, end: float, depth: int) -> None:
        """One increment, in halves if the routine asks for it."""
        last, now = at(self.history, row, begin), at(self.history, row, end)
        if self._try(last, now):
            return
        self.result.cut_backs += 1
        if depth >= self.history.cut_backs:
            raise RoutineError(
                f"{self.result.routine} asks for a smaller time increment (PNEWDT = "
                f"{self.pnewdt:g}) at time {now.time:g} after {depth} cut-backs; cut_backs = "
                f"{self.history.cut_backs} is the limit"
            )
        middle = 0.5 * (begin + end)
        self._take(row, begin, middle, depth + 1)
        self._take(row, middle, end, depth + 1)

    def _try(self, last: Row, now: Row) -> bool:
        """One increment; False if it was cut back."""
        driver, start = self.driver, self.history.time[0]
        self._put(now)
        self.bound.put({"slip_increment": (now.slip - last.slip).T})
        driver.begin_increment(
            now.time - last.time,
            step_time=now.time - start,
            total_time=now.time,
            increment=self.increment + 1,
        )
        entry = np.array(driver.state["condition"])
        for _ in range(self.history.iterations):
            answer = driver.iterate()
            if answer.cut_back:
                self.pnewdt = float(answer.pnewdt)
                driver.cut_back()
                return False
            settled = np.array_equal(answer.lm, entry)
            entry = np.array(answer.lm)
            if settled:
                break
        self.unsettled += not settled
        self._keep(now, answer, last)
        driver.commit()
        if self.states:
            self.kept["state"].append(np.array(driver.state["state"], dtype=float).T)
        self.increment += 1
        return True

    def _put(self, now: Row) -> None:
        coord = np.zeros((self.dimension, self.history.points))
        width = min(self.history.directions, self.dimension)
        coord[:width] = now.slip.T[:width]
        values = {"pressure": now.pressure, "coord": coord}
        if now.temperature is not None:
            values["temperature_secondary"], values["temperature_main"] = now.temperature
        if now.fields is not None:
            values["field_secondary"], values["field_main"] = (f.T for f in now.fields)
        self.bound.put(values)

    def _keep(self, now: Row, answer, last: Row) -> None:
        kept = self.kept
        kept["time"].append(now.time)
        kept["slip"].append(now.slip)
        kept["pressure"].append(now.pressure)
        for name in _OUTPUTS:
            value = np.array(getattr(answer, name))
            kept[name].append(value if name == "lm" else value.T.astype(float))
        if self.result.interface == "fric_coef":
            kept["coefficient"].append(np.array(self.driver.array("coefficient"))[0].astype(float))
        size = np.linalg.norm(kept["tau"][-1], axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            kept["mobilised"].append(np.where(now.pressure > 0.0, size / now.pressure, 0.0))
        moved = np.any(now.slip != last.slip, axis=1)
        self.rough += int(np.count_nonzero((kept["lm"][-1] == 1) & moved))
