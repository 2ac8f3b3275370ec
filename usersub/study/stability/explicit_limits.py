# SPDX-License-Identifier: MIT
"""Limits of explicit time integration: steps, masses, direct effects."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from usersub.study.stability.bisecting import limit
from usersub.study.stability.cell import Limit

_STEPS, _QUICK_STEPS = 2000, 400
_REAL = {"double": np.float64, "single": np.float32}


class Block:
    """A point mass on a plane, one step of central differences at a time."""

    def __init__(
        self, law: str, props: tuple[float, ...], interface: str, precision: str = "double",
        states: int = 0, load: float = 1.0, warm: float = 20.0, **settings: Any,
    ) -> None:  # fmt: skip
        from usersub import ExplicitDriver, Scene, laws

        real = _REAL[precision]
        routine = laws.routine(law, interface, "c", precision=precision)
        scene = Scene(
            points=1, dimension=3, precision=precision, props=props, states=states, nodes=5,
            **settings,
        )  # fmt: skip
        self.driver = ExplicitDriver(routine, scene, reuse=True)
        self.slip = np.zeros((3, 1), real, order="F")
        arrays: dict[str, np.ndarray] = {
            "slip_increment": self.slip,
            "normal": np.array([[0.0], [0.0], [1.0]], real, order="F"),
            "normal_force": np.array([load], real),
            "secondary_node": np.ones((1, 1), np.int32, order="F"),
            "main_node": np.full((4, 1), 2, np.int32, order="F"),
        }
        if "enforcement" not in settings:
            arrays["stick_force"] = np.array([1e30], real)
        if settings.get("enforcement") == "kinematic":
            arrays["mass"] = np.ones(1, real)
        for side in ("temperature_secondary", "temperature_main"):
            if side in self.driver.layout.ports:
                arrays[side] = np.full(self.driver.layout.shapes[side], warm, real, order="F")
        self.arrays = {k: a for k, a in arrays.items() if k in self.driver.layout.ports}
        self.driver.bind(**self.arrays)

    def force(self, slip: float, dt: float) -> float:
        """Friction force after a slip in a step."""
        self.slip[0, 0] = slip
        return float(self.driver.step(dt).force[0, 0])


def _settles(
    make: Callable[[], Block], dt: float, mass: float, steps: int,
    drive: float = 0.0, speed: float = 0.0,
) -> bool:  # fmt: skip
    """Whether a small disturbance of the speed does not grow."""
    block, small = make(), 1e-3 * (speed or 1.0)
    velocity = speed + small
    for _ in range(steps):
        velocity += dt / mass * (drive + block.force(velocity * dt, dt))
        if not abs(velocity - speed) < 20.0 * small:
            return False
    return True


def spring_steps(steps: int) -> Iterator[Limit]:
    """Penalty: 2/omega, with damping the root of K dt^2 + 2 C dt = 4 m; P7's block among them."""
    cases = (
        ("penalty", "vfric_coef", 1.0, 0.0, 1.0),
        ("penalty, P7", "vfric_coef", 1e5, 0.05 * 2.0 * math.sqrt(1e5), 1.0),
        ("penalty, mass 1e-9", "vfric_coef", 1.0, 0.0, 1e-9),
        ("penalty, mass 1e9", "vfric_coef", 1.0, 0.0, 1e9),
        ("penalty, force", "vfriction", 1.0, 0.0, 1.0),
    )
    for name, interface, slope, damping, mass in cases:
        for precision in ("double", "single"):
            settings: dict[str, Any] = {"enforcement": "penalty", "stick_slope": slope}
            if damping:
                settings["damping"] = damping

            def make() -> Block:
                return Block("coulomb", (1e12,), interface, precision, load=1e12, **settings)  # noqa: B023

            theory = (math.sqrt(damping**2 + 4.0 * slope * mass) - damping) / slope
            found = limit(lambda dt: _settles(make, dt, mass, steps), theory)  # noqa: B023
            words = "block on the elastic slip of the driver, central differences; theory 2/omega"
            if damping:
                words = "block of P7, 5 % of critical damping; theory K dt^2 + 2 C dt = 4 m"
            yield Limit(
                "largest stable step", f"driver: {name}", interface, "c", precision, found, theory,
                "time", words,
            )  # fmt: skip


def viscous_steps(steps: int) -> Iterator[Limit]:
    """Laws that grow with the slip rate: 2 m over their slope, without the bound of sticking."""
    props = {"damping": (0.5,), "viscoplastic_creep": (0.02,), "norton_hoff": (40.0, 0.15, 1e-3)}
    slope = {
        "damping": lambda v: 0.5,
        "viscoplastic_creep": lambda v: 1.0 / 0.02,
        "norton_hoff": lambda v: 40.0 * 0.15 * v**0.15 / v,
    }
    for law, numbers in props.items():

        def make() -> Block:
            return Block(law, numbers, "vfriction")  # noqa: B023

        speed = 1.0
        drive = -make().force(speed, 1.0)
        theory = 2.0 / slope[law](speed)
        found = limit(lambda dt: _settles(make, dt, 1.0, steps, drive, speed), theory)  # noqa: B023
        yield Limit(
            "largest stable step", law, "vfriction", "c", "double", found, theory, "time",
            "steady sliding of a unit mass, stick force out of reach; theory 2 m/(d force/d rate)",
        )  # fmt: skip


def direct_effect(steps: int) -> Iterator[Limit]:
    """Rate and state: the direct effect is a damper of a p/V."""
    a, rate, load = 0.01, 1e-6, 100.0
    for law in ("rate_state_regularised", "rate_state_ageing", "rate_state_slip"):
        numbers: tuple[float, ...] = (0.6, a, 1e-9, rate, 1e-5, 10.0)
        if law != "rate_state_regularised":
            numbers = (*numbers, 1e-15)

        def make() -> Block:
            return Block(law, numbers, "vfriction", states=1, load=load)  # noqa: B023

        damper = a * load / rate
        mass = 0.05 * damper  # a limit of 0.1, a hundredth of Dc/V
        drive = -make().force(rate * 0.1, 0.1)
        found = limit(lambda dt: _settles(make, dt, mass, steps, drive, rate), 0.1)  # noqa: B023
        yield Limit(
            "largest stable step", law, "vfriction", "c", "double", found, 2.0 * mass / damper,
            "time", "steady sliding at V, stick force out of reach; theory 2 m V/(a p)",
        )  # fmt: skip


def kinematic_masses() -> Iterator[Limit]:
    """Two bodies of which one is up to 1e9 times heavier: a kinematic step ends their slip."""
    for ratio in (1.0, 1e3, 1e6, 1e9):
        for precision in ("double", "single"):
            block = Block(
                "coulomb", (0.3,), "vfric_coef", precision, load=1e6, enforcement="kinematic"
            )
            light, heavy, dt = 1.0, ratio, 1e-3
            block.arrays["mass"][0] = light * heavy / (light + heavy)
            force = block.force(1.0 * dt, dt)
            left = abs(1.0 + dt * force * (1.0 / light + 1.0 / heavy))
            yield Limit(
                f"slip rate left by one step, masses 1:{ratio:g}", "driver: kinematic",
                "vfric_coef", "c", precision, left, 0.0, "of the first",
                "mass of the pair m1 m2/(m1 + m2); theory: none is left",
            )  # fmt: skip


def bristle_steps(quick: bool) -> Iterator[Limit]:
    """Bristles: update formulas of first order end at 2 g/(sigma v); these have no limit."""
    laws_props = {
        "dahl": (0.3, 1e5),
        "lugre": (0.3, 0.3, 0.01, 2.0, 1e5, 0.0, 0.0),
        "elasto_plastic": (0.3, 0.3, 0.01, 2.0, 1e5, 0.0, 0.0, 0.9),
    }
    limit_slip = 0.3 * 100.0 / 1e5
    for law, props in laws_props.items():
        largest = 0.0
        for factor in (1e-2, 0.1, 1.0, 2.0, 10.0, 100.0, 1e3):
            block = Block(law, props, "vfriction", states=3, load=100.0)
            count = min(int(50.0 / factor) + 3, 400 if quick else 6000)
            forces = [-block.force(factor * limit_slip, 1.0) for _ in range(count)]
            slid = factor * count > 45.0
            good = max(forces) <= 30.0 * (1 + 1e-15) and min(np.diff(forces), default=0.0) > -1e-12
            if good and (not slid or abs(forces[-1] - 30.0) < 1e-12 * 30.0):
                largest = factor
        yield Limit(
            "largest step that rises to mu p and no further", law, "vfriction", "c", "double",
            largest, None, "g/(sigma v)",
            "0.01 to 1000 were tried; formulas of first order are unstable from 2 on (P13)",
        )  # fmt: skip


def all_of(quick: bool) -> Iterator[Limit]:
    """All limits of explicit integration."""
    steps = _QUICK_STEPS if quick else _STEPS
    yield from spring_steps(steps)
    yield from viscous_steps(steps)
    yield from direct_effect(200)
    yield from kinematic_masses()
    yield from bristle_steps(quick)
