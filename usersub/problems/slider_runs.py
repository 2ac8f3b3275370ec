# SPDX-License-Identifier: MIT
"""Runs of the rubbing mass (P5 to P8) by every method, compared with the exact answer."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from usersub.errors import SceneError
from usersub.problems.choose import positive
from usersub.problems.problem import Outcome
from usersub.problems.slider import Event, Follower, System
from usersub.problems.slider_explicit import CentralDifferences, KinematicContact, Rubbing
from usersub.problems.slider_implicit import ImplicitContact

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Hosts and enforcement by interface.
METHODS = {
    "vfric": ("kinematic events", "kinematic"),
    "vfriction": ("kinematic events", "kinematic"),
    "vfric_coef": ("kinematic events", "kinematic", "penalty"),
    "fric": ("penalty events",),
    "fric_coef": ("penalty events", "lagrange events"),
}

OPTIONS = {
    "points": "contact points that share the mass",
    "steps": "increments of the whole run",
    "elastic_slip": "allowable elastic slip of implicit penalty enforcement",
    "stiffness": "stiffness of explicit penalty enforcement over the problem's own; the damping "
    "goes with its root",
}

#: For a problem that ends at rest.
HOLD = {"hold": "increments of rest after the end; details['creep'] is the motion in them"}

#: Rounding of a coefficient in single precision, as it grows in the answer.
_SINGLE_TOLERANCE = 2e-5

#: Increments of a run from event to event: the answer does not depend on it.
_EVENT_STEPS = 150


@dataclass(frozen=True)
class Slider:
    """A problem of the rubbing mass.

    Attributes:
        name: "P5", ...
        system: the masses.
        props: properties by law.
        static: coefficient at rest.
        end: duration of the run.
        measure: named numbers of a run.
        exact: their exact values.
        scale: what errors of numbers are relative to, where not to themselves.
        allowable: elastic slip of penalty enforcement, implicit.
        slope: stiffness of penalty enforcement, explicit. damping: with it.
        steps: increments by method of central differences.
        tolerance: relative error by method; by default rounding.
        count: events of a run, None for all.
        compared: the numbers in words, where their names are too many.
    """

    name: str
    system: System
    props: Mapping[str, list[float]]
    static: float
    end: float
    measure: Callable[[list[Event]], dict[str, float]]
    exact: Mapping[str, float]
    allowable: float
    slope: float
    damping: float
    steps: Mapping[str, int]
    tolerance: Mapping[str, float]
    scale: Mapping[str, float] = field(default_factory=dict)
    count: int | None = None
    compared: str = ""

    def run(
        self,
        routine: Routine,
        law: str,
        precision: str,
        method: str,
        *,
        points: int = 3,
        steps: int | None = None,
        hold: int = 0,
        elastic_slip: float | None = None,
        stiffness: float = 1.0,
    ) -> Outcome:
        """One run."""
        if steps is not None and steps < 1:
            raise SceneError(f"problem {self.name}: steps is {steps}, expected 1 or more")
        steps = steps or self.steps.get(method, _EVENT_STEPS)
        soft = replace(
            self,
            allowable=positive(self.name, "elastic_slip", elastic_slip, self.allowable),
            slope=self.slope * positive(self.name, "stiffness", stiffness, 1.0),
            damping=self.damping * math.sqrt(stiffness),
        )
        # No event falls upon the end of an increment by itself.
        step = self.end / (steps - 0.37)
        host, watch = soft._host(routine, law, precision, method, points, step)
        events = (
            host.follow(self.end, self.count)
            if isinstance(host, Follower)
            else host.run(self.end, self.count)
        )
        creep = host.hold(hold) if hold else 0.0
        errors = self.errors(events)
        tolerance = self.tolerance.get(method, 1e-11)
        if precision == "single":
            tolerance = max(tolerance, _SINGLE_TOLERANCE)
        return Outcome(
            problem=self.name, law=law, interface=routine.interface.name,
            language=routine.language, precision=precision, method=method,
            step=step, points=points, error=float(np.max([*errors.values()])),
            error_of=self.compared or ", ".join(errors), tolerance=tolerance,
            details={**errors, "creep": creep},
            **watch.times(points),
        )  # fmt: skip

    def errors(self, events: list[Event]) -> dict[str, float]:
        """Relative errors; NaN where a run lacks an event."""
        try:
            found = self.measure(events)
        except (IndexError, StopIteration, ValueError):
            found = {}
        return {
            name: abs(found.get(name, np.nan) - exact) / self.scale.get(name, abs(exact))
            for name, exact in self.exact.items()
        }

    def _host(self, routine, law, precision, method, points, increment):
        props, (enforcement, _, events) = list(self.props[law]), method.partition(" ")
        if not routine.interface.name.startswith("v"):
            contact = ImplicitContact(
                routine, props, self.system, points, self.static, self.allowable,
                "lagrange" if enforcement == "lagrange" else "default",
            )  # fmt: skip
            return Follower(self.system, contact, increment), contact.watch
        settings = (
            {"stick_slope": self.slope, "damping": self.damping} if enforcement == "penalty" else {}
        )
        rubbing = Rubbing(routine, props, self.system, points, precision, enforcement, **settings)
        host = (
            Follower(self.system, KinematicContact(rubbing), increment)
            if events
            else CentralDifferences(self.system, rubbing, increment)
        )
        return host, rubbing.contact.watch
