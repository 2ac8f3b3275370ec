# SPDX-License-Identifier: MIT
"""An interaction over the steps of an analysis: its driver, which changes with its friction."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from usersub.driver.clock import real
from usersub.driver.explicit import ExplicitDriver
from usersub.driver.standard import StandardDriver, StandardResponse
from usersub.errors import SceneError
from usersub.interaction import changing
from usersub.interaction.at_rest import set_open_points
from usersub.interaction.changing import Change
from usersub.interaction.friction import SETTINGS, Friction

if TYPE_CHECKING:
    import numpy as np

    from usersub.driver.scene import Scene

_DRIVERS = {"standard": StandardDriver, "explicit": ExplicitDriver}


class Interaction:
    """Friction between two surfaces, step by step.

    Implicit analyses: `begin_step`, then increments as of a `StandardDriver`: `begin_increment`,
    `iterate`, `commit` or `cut_back`. Explicit ones: `begin_step`, then `driver.step(...)`.
    In the first step, a change that is not made at once starts from a coefficient of zero.

    Args:
        friction: what acts from the start; None is frictionless.
        scene: the host's model, without the settings of the friction.
        solver: "standard" or "explicit".
        changes: changes by number of the step, that `begin_step` makes by itself.
        ramps: whether steps, by their number, ramp a change without an amplitude; by default they
            do, as static steps.

    Attributes:
        friction: what acts in the step of now (at its end, where it changes).
        driver: the driver of now; another one after a change.
        step: number of the step of now, 0 before the first.

    Raises:
        SceneError: friction, scene and solver do not fit.
    """

    def __init__(
        self,
        friction: Friction | None,
        scene: Scene,
        *,
        solver: str = "standard",
        changes: Mapping[int, Change] | None = None,
        ramps: Mapping[int, bool] | None = None,
        reuse: bool = False,
    ) -> None:
        if solver not in _DRIVERS:
            raise SceneError(f"solver '{solver}'; expected one of {', '.join(_DRIVERS)}")
        for key in SETTINGS:
            if key in ("fields", "temperatures"):  # the host's surfaces have them or not
                continue
            given = scene.props if key == "props" else scene[key]
            if given != getattr(type(scene)(), key):
                raise SceneError(
                    f"the scene of an interaction has '{key}' = {given!r}, which belongs to its "
                    f"friction; expected usersub.Friction(law, {key}=...)"
                )
        self.solver, self.step, self._reuse, self._scene = solver, 0, reuse, scene
        self._changes, self._ramps = dict(changes or {}), dict(ramps or {})
        self._original = self.friction = friction if friction is not None else Friction()
        self._arrays: dict[str, np.ndarray] = {}
        self._time = self._step_time = 0.0  # at the end of the last committed increment
        self._increment: float | None = None  # length of the open increment
        self._curve: Any = None  # amplitude against step time; None: nothing changes
        self._change_step = 0  # step whose change the driver is in
        self._frozen: float | None = None  # amplitude that an earlier step ended with
        self.driver = self._make(self.friction, changing.AT_ONCE)

    def _make(self, friction: Friction, manner: int) -> Any:
        scene = friction.scene(self._scene)
        if manner:
            scene = scene.replace(changing=manner)
        driver = _DRIVERS[self.solver](friction.acting_law(), scene, reuse=self._reuse)
        fitting = {n: a for n, a in self._arrays.items() if n in driver.layout.ports}
        driver.bind(**fitting)
        return driver

    def bind(self, **arrays: np.ndarray) -> None:
        """Binds the host's arrays, for this driver and those of later steps.

        Raises:
            SceneError: an array does not fit; nothing has changed.
        """
        self.driver.bind(**arrays)
        self._arrays.update(arrays)

    def begin_step(
        self,
        period: float = 1.0,
        change: Change | None = None,
        *,
        ramp: bool | None = None,
    ) -> None:
        """Begins the next step, in which the friction may change.

        Args:
            period: its length, over which a ramp goes.
            change: the change of friction; by default that of `changes`, if there is one.
            ramp: whether a change without an amplitude is ramped (as in static steps) or made at
                once (as in transient ones); by default that of `ramps`.

        Raises:
            SceneError: the friction cannot change so, or an increment is open; nothing has changed.
        """
        if self._increment is not None:
            raise SceneError("an increment is open; commit or cut back before the next step begins")
        if not 0.0 < period < math.inf:
            raise SceneError(f"period = {period!r}; expected a finite time above 0")
        number = self.step + 1
        change = self._changes.get(number) if change is None else change
        ramp = self._ramps.get(number, True) if ramp is None else ramp
        if change is None:
            if self._curve is not None:
                self._frozen = self._amplitude()
        else:
            self._take(change, number, period, ramp)
        self.step, self._step_time = number, 0.0

    def _take(self, change: Change, number: int, period: float, ramp: bool) -> None:
        new = change.target(self._original, self.friction)
        changing.check(self.friction, new)
        if self.solver == "explicit" and change.amplitude is not None:
            raise SceneError("an explicit analysis changes friction at once, without an amplitude")
        gradual = self.solver == "standard" and (change.amplitude is not None or ramp)
        manner = changing.manner(self.friction, new, first=number == 1, at_once=not gradual)
        driver = self._make(new, manner)
        if number > 1:
            if manner != changing.AT_ONCE:
                set_open_points(self.driver, self.friction, self._amplitude())
            _carry(self.driver, driver)
        self.driver, self.friction, self._change_step = driver, new, number
        self._frozen = None
        if manner == changing.AT_ONCE:
            self._curve = None
        elif change.amplitude is not None:
            self._curve = change.amplitude.value
        else:
            self._curve = lambda time: min(time / period, 1.0)

    def _amplitude(self, time: float | None = None) -> float:
        """How far the friction has changed at a step time, by default that of now."""
        if self._frozen is not None or self._curve is None:
            return 1.0 if self._frozen is None else self._frozen
        return self._curve(self._step_time if time is None else time)

    # Increments of an implicit analysis.

    def begin_increment(self, time_increment: float) -> None:
        """Opens an increment of the step; the amplitude is that at its end.

        Raises:
            SceneError: no step has begun, or as `StandardDriver.begin_increment`.
        """
        if self.step == 0:
            raise SceneError("no step has begun; expected begin_step(period) first")
        length = real("time_increment", time_increment)
        end = self._step_time + length
        more: dict[str, Any] = {"step": self.step}
        if self._curve is not None:
            # To the driver a finished change goes on in its own step, as its start values do.
            more["step"] = self._change_step
            more["amplitude"] = self._amplitude(end)
        self.driver.begin_increment(length, step_time=end, total_time=self._time + length, **more)
        self._increment = length

    def iterate(self, **arrays: np.ndarray) -> StandardResponse:
        """One iteration, after binding `arrays`; as `StandardDriver.iterate`."""
        if arrays:
            self.bind(**arrays)
        return self.driver.iterate()

    def commit(self) -> None:
        """Accepts the last iteration."""
        self.driver.commit()
        self._step_time += self._increment or 0.0
        self._time += self._increment or 0.0
        self._increment = None

    def cut_back(self) -> None:
        """Forgets the increment."""
        self.driver.cut_back()
        self._increment = None


def _carry(old: Any, new: Any) -> None:
    """Copies the committed state that both drivers have."""
    for name in new.state:
        if name in old.state and name != "state":
            before, after = old.state[name], new.state[name]
            if before.shape == after.shape and before.dtype == after.dtype:
                after[...] = before
