# SPDX-License-Identifier: MIT
"""What the runs of a case through the three kinds of driver have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.check.respond.answer import Answer
from usersub.errors import Error

if TYPE_CHECKING:
    from usersub.check.case import Case, Step
    from usersub.check.subject import Subject
    from usersub.driver.base import Driver
    from usersub.driver.observed import Observed


class Run(ABC):
    """A case in a driver, run step by step.

    Points stand in the arrays in the order `case.order`; answers come back in that of the case.

    Attributes:
        driver: the driver, made with the arrays bound.
    """

    driver: Driver

    def __init__(self, subject: Subject, case: Case, options: dict[str, Any]) -> None:
        if subject.routine is None:
            raise Error(f"{subject.name} could not be loaded: {subject.failure}")
        self.subject, self.case, self.options = subject, case, dict(options)
        self.order = np.array(case.order if case.order is not None else range(case.points))
        self.back = np.argsort(self.order)
        self.real = np.float32 if subject.precision == "single" else np.float64

    def settings(self, **own: Any) -> dict[str, Any]:
        """Settings of the scene."""
        subject, case = self.subject, self.case
        props = subject.props if case.props is None else case.props
        interaction, secondary, main = case.names or subject.around.names
        common = {
            "points": case.points,
            "props": props,
            "states": subject.states,
            "fields": subject.fields,
            "temperatures": int(subject.temperatures),
            "precision": subject.precision,
            "interaction": interaction,
            "secondary": secondary,
            "main": main,
        }
        return {**common, **own, **self.options}

    def step_number(self, index: int) -> int:
        """Number of the analysis step that increment `index` is in."""
        numbers = self.case.step_numbers or self.subject.around.step_numbers
        return numbers[min(index, 1)]

    def observed(self) -> Observed:
        """What a checked driver saw in the last step."""
        return self.driver.observed()

    def ready(self, index: int) -> None:
        """Runs step `index`, and leaves the driver so that its bare call repeats it."""
        self.step(index)

    def answers(self) -> dict[str, np.ndarray]:
        """Copies of all that the driver's call gave, by the names of its arrays."""
        driver = self.driver
        names = [n for n, p in driver.layout.ports.items() if p.role in ("out", "state")]
        return {n: driver.array(n).copy() for n in names if driver.keeps(n)}

    @abstractmethod
    def step(self, index: int) -> Answer:
        """Runs step `index` of the case.

        Raises:
            Error: the routine failed, or the driver refuses the step.
        """

    def load(self, saved: bytes, step: int) -> None:
        """Goes on from a saved state of the driver, which was made before step number `step`."""
        self.driver.state.load(saved)

    def _put(self, **arrays: np.ndarray) -> dict[str, Any]:
        """Arrays with the point last, in the order of the driver, as the driver wants them."""
        return {
            name: np.asfortranarray(a[..., self.order], dtype=self.real)
            for name, a in arrays.items()
        }

    def _back(self, array: np.ndarray | None) -> np.ndarray | None:
        """An array of the driver in the order of the case."""
        return None if array is None else np.array(array[..., self.back], order="F")

    def _surroundings(self, step: Step) -> dict[str, np.ndarray]:
        """Temperatures (N,) and fields (P, N) of both surfaces, where the subject has them.

        Every point has its own values, so that none can be mistaken for another.
        """
        subject, n = self.subject, self.case.points
        points = np.arange(n)
        found: dict[str, np.ndarray] = {}
        if subject.temperatures:
            base = subject.scales.temperature
            pair = np.array([base + 0.5 * points, base + 3.0 + 0.25 * points])
            if step.temperature is not None:
                pair = np.array(step.temperature, dtype=float).T
            found["temperature_secondary"], found["temperature_main"] = pair
        if subject.fields:
            values = subject.scales.fields or (0.5,) * subject.fields
            base_fields = np.array(values)[:, None] * (1.0 + 0.01 * points)
            found["field_secondary"], found["field_main"] = base_fields, 1.02 * base_fields
            if step.fields is not None:
                found["field_secondary"] = np.array([f[0] for f in step.fields], dtype=float).T
                found["field_main"] = np.array([f[1] for f in step.fields], dtype=float).T
        return found

    def _initial_state(self) -> None:
        """Sets the initial state variables of the case."""
        if self.case.state is None or "state" not in self.driver.state:
            return
        state = self.driver.state["state"]
        values = np.array(self.case.state, dtype=float)
        state[...] = values.reshape((-1,) + (1,) * (state.ndim - 1))

    def _turn(self) -> np.ndarray:
        """Matrix from the directions of the case to those of the model."""
        c, s = np.cos(self.case.angle), np.sin(self.case.angle)
        return np.array([[c, -s], [s, c]])
