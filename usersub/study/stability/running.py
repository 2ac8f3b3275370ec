# SPDX-License-Identifier: MIT
"""Runs a history through the real driver; a point that is refused is taken out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from usersub.errors import Error
from usersub.study.stability.histories import History

#: Allowable elastic slip by the ordinary slip.
ALLOWABLE = 0.01
#: A stick force beyond friction.
AMPLE = 1e30
#: Slowest that a guarded routine may be, seconds a call.
_TIME_LIMIT = 2.0


@dataclass
class Trace:
    """What came of a history.

    Attributes:
        history: that it came of.
        friction: stress, or force against the slip, shape (increments, 2, N); NaN from the
            increment on in which a point was refused.
        coefficient: where the interface gives one, shape (increments, 2, N), else None.
        refused: by point, increment and error.
        stick: the stick force that bounded the friction, shape (increments, N), else None.
    """

    history: History
    friction: np.ndarray
    coefficient: np.ndarray | None = None
    refused: dict[int, tuple[int, Error]] = field(default_factory=dict)
    stick: np.ndarray | None = None


def run(history: History) -> Trace:
    """The history through the driver of its subject."""
    subject = history.subject
    trace = Trace(history, np.full(history.motion.shape, np.nan))
    try:
        host = (_Standard if subject.standard else _Explicit)(history)
    except Error as error:
        for point in range(history.points):
            trace.refused[point] = (0, error)
        return trace
    host.run(trace)
    return trace


class _Host:
    """What both hosts do."""

    def __init__(self, history: History) -> None:
        self.history, self.subject = history, history.subject
        n = history.points
        self.real = np.float64 if self.subject.precision == "double" else np.float32
        self.driver = self._make()
        if self.subject.checked:
            self.driver.time_limit = _TIME_LIMIT
        self.arrays: dict[str, np.ndarray] = {}
        self._bind(n)

    def _scene(self, **settings: Any) -> Any:
        from usersub import Scene

        subject = self.subject
        own = {k: v for k, v in subject.settings.items() if k != "elastic_slip_over"}
        return Scene(
            points=self.history.points, dimension=3, precision=subject.precision,
            props=subject.props, states=subject.states, temperatures=subject.temperatures,
            checked=int(subject.checked), **{**settings, **own},
        )  # fmt: skip

    def _make(self) -> Any:
        raise NotImplementedError

    def _bind(self, n: int) -> None:
        raise NotImplementedError

    def _increment(self, i: int, trace: Trace) -> None:
        raise NotImplementedError

    def _fill(self, known: dict[str, Any]) -> None:
        """Arrays that a routine may read and that are the same for all cases."""
        layout = self.driver.layout
        for name in ("coord", "coord_main", "coord_secondary", "velocity", "rotation"):
            if name in layout.ports and name not in known and layout.ports[name].role == "in":
                known[name] = np.zeros(layout.shapes[name], self.real, order="F")
        if "rotation" in known:
            known["rotation"][[0, 1], [0, 1]] = 1.0
        for side in ("secondary", "main"):
            name = f"temperature_{side}"
            if self.subject.temperatures and name in layout.ports:
                shape = layout.shapes[name]
                known[name] = np.asfortranarray(
                    np.broadcast_to(self.history.temperature.astype(self.real), shape)
                ).copy()
        self.arrays = known
        self.driver.bind(**known)

    def run(self, trace: Trace) -> None:
        """All increments; refused points are opened and left behind."""
        n = self.history.points
        for i in range(len(self.history.dt)):
            while len(trace.refused) < n:
                try:
                    self._increment(i, trace)
                    break
                except Error as error:
                    point = getattr(error, "point", None)
                    gone = range(n) if point is None else [point]
                    if all(p in trace.refused for p in gone):
                        gone = range(n)
                    for p in gone:
                        trace.refused.setdefault(p, (i, error))
        for p, (i, _) in trace.refused.items():
            trace.friction[i:, :, p] = np.nan


class _Standard(_Host):
    def _make(self) -> Any:
        from usersub import StandardDriver

        subject = self.subject
        allowable = ALLOWABLE * subject.scales.slip
        allowable *= float(subject.settings.get("elastic_slip_over", 1.0))
        scene = self._scene(characteristic_length=200.0 * allowable)
        return StandardDriver(subject.make(), scene, reuse=True)

    def _bind(self, n: int) -> None:
        known: dict[str, Any] = {
            "slip_increment": np.zeros((2, n), order="F"),
            "pressure": np.full(n, self.subject.scales.load),
        }
        self.lagrange = self.subject.settings.get("enforcement") == "lagrange"
        if self.lagrange:
            known["multiplier"] = np.zeros((2, n), order="F")
        self._fill(known)
        self.changing = bool(self.subject.settings.get("changing"))
        self._open(self.history.dt[0])
        self.driver.iterate()
        self.driver.commit()

    def _open(self, dt: float) -> None:
        more = {"amplitude": 0.5} if self.changing else {}
        self.driver.begin_increment(float(dt), **more)

    def _increment(self, i: int, trace: Trace) -> None:
        history, arrays = self.history, self.arrays
        gone = list(trace.refused)
        arrays["slip_increment"][...] = history.motion[i]
        arrays["pressure"][...] = history.load[i]
        arrays["slip_increment"][:, gone] = 0.0
        arrays["pressure"][gone] = 0.0
        self._open(history.dt[i])
        try:
            response = self.driver.iterate()
            if self.lagrange:  # an iteration in which the host knows the multipliers
                arrays["multiplier"][...] = 0.15 * history.load[i] * np.array([[0.8], [0.6]])
                arrays["multiplier"][:, gone] = 0.0
                response = self.driver.iterate()
        except Error:
            self.driver.cut_back()
            raise
        trace.friction[i] = response.tau
        if "coefficient" in self.driver.layout.ports:
            if trace.coefficient is None:
                trace.coefficient = np.full(trace.friction.shape, np.nan)
            trace.coefficient[i] = self.driver.array("coefficient")
        self.driver.commit()


class _Explicit(_Host):
    def _make(self) -> Any:
        from usersub import ExplicitDriver

        n = self.history.points
        sizes: dict[str, Any] = {"nodes": n + 4}
        if self.subject.interface == "vfric":
            sizes = {"secondary_nodes": n, "main_nodes": 4}
        return ExplicitDriver(self.subject.make(), self._scene(**sizes), reuse=True)

    def _bind(self, n: int) -> None:
        real, layout = self.real, self.driver.layout
        normal = np.zeros((3, n), real, order="F")
        normal[2] = 1.0
        node = np.arange(1, n + 1, dtype=np.int32)
        vfric = self.subject.interface == "vfric"
        known: dict[str, Any] = {
            "slip_increment": np.zeros((3, n), real, order="F"),
            "normal": normal,
            "normal_force": np.zeros(n, real),
            "secondary_node": node if vfric else node.reshape(1, n, order="F"),
            "main_node": np.full(
                layout.shapes["main_node"], 1 if vfric else n + 1, np.int32, order="F"
            ),
        }
        own = self.subject.settings.get("enforcement") in ("kinematic", "penalty")
        own = own or bool(self.subject.settings.get("stick_slope"))
        self.own = own
        if not own:
            ample = AMPLE if self.real is np.float32 else 1e305
            stick = self.history.stick
            known["stick_force"] = np.full(n, ample, real) if stick is None else stick.astype(real)
        if self.subject.settings.get("enforcement") == "kinematic":
            mass = self.history.mass
            known["mass"] = np.ones(n, real) if mass is None else mass.astype(real)
        self._fill({k: v for k, v in known.items() if k in layout.ports})

    def _increment(self, i: int, trace: Trace) -> None:
        history, arrays = self.history, self.arrays
        gone = list(trace.refused)
        with np.errstate(over="ignore", under="ignore"):
            arrays["slip_increment"][:2] = history.motion[i]
            arrays["normal_force"][...] = np.maximum(history.load[i], 0.0)
        arrays["slip_increment"][:, gone] = 0.0
        arrays["normal_force"][gone] = 0.0
        if "stick_force" in arrays:
            arrays["stick_force"][gone] = 0.0
        response = self.driver.step(float(history.dt[i]))
        trace.friction[i] = -response.force[:2]
        if response.coefficient is not None:
            if trace.coefficient is None:
                trace.coefficient = np.full(trace.friction.shape, np.nan)
            trace.coefficient[i] = response.coefficient
        if not self.own:
            if trace.stick is None:
                trace.stick = np.full(trace.friction[:, 0].shape, np.nan)
            trace.stick[i] = arrays["stick_force"]
