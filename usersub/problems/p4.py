# SPDX-License-Identifier: MIT
"""P4: a coefficient that depends on slip rate, pressure and temperature, on a sliding rod."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from usersub.problems import fixed
from usersub.problems.problem import Outcome, Problem, Stopwatch

if TYPE_CHECKING:
    from usersub.routine.routine import Routine

#: Static coefficient by temperature and by pressure, kinetic ones, decay; chosen here.
PROPS = (8e-4, 2.5e-5, 3e-4, 1e-5, 0.02)

#: Table of the twin: slip rates up to the highest, which suffice for the tolerance; the
#: coefficient is linear in pressure and temperature, so two points do.
HIGHEST_RATE, TABLE_POINTS = 320.0, 641
TABLE_PRESSURES = np.array([50.0, 3500.0])
TABLE_TEMPERATURES = np.array([10.0, 300.0])

#: Relative error: rounding; of the table h^2 dc^2/8 of the decaying part, which is at most three
#: times the rest.
TOLERANCES = {"temperature_pressure_decay": 1e-12, "coulomb_tabulated": 4e-5}

#: Increments of the rod.
_INCREMENTS = 12


class Exact(NamedTuple):
    """The coefficient and its derivatives by slip rate, pressure and temperature."""

    mu: np.ndarray
    by_rate: np.ndarray
    by_pressure: np.ndarray
    by_temperature: np.ndarray


def exact(rate: np.ndarray, pressure: np.ndarray, temperature: np.ndarray) -> Exact:
    """mu = muk + (mus - muk) exp(-dc rate), mus = Cs T + Ds p, muk = Ck T + Dk p."""
    cs, ds, ck, dk, dc = PROPS
    share = np.exp(-dc * rate)
    change = (cs - ck) * temperature + (ds - dk) * pressure
    return Exact(
        ck * temperature + dk * pressure + change * share,
        -dc * change * share,
        dk + (ds - dk) * share,
        ck + (cs - ck) * share,
    )


def props(law: str, table_points: int = TABLE_POINTS) -> list[float]:
    """Properties of the law or of its tabulated twin."""
    if law == "temperature_pressure_decay":
        return list(PROPS)
    rates = np.linspace(0.0, HIGHEST_RATE, table_points)
    t, p, r = np.meshgrid(TABLE_TEMPERATURES, TABLE_PRESSURES, rates, indexing="ij")
    axes = [rates, TABLE_PRESSURES, TABLE_TEMPERATURES]
    sizes = [*(axis.size for axis in axes), 0]  # no field variables
    return np.concatenate([sizes, *axes, exact(r, p, t).mu.ravel()]).tolist()


def _relative(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.abs(found / expected - 1.0).max())


def _compared(law: str) -> tuple[bool, str]:
    """Whether the derivative by slip rate is compared; a table's is of first order only."""
    smooth = law == "temperature_pressure_decay"
    return smooth, "derivatives" if smooth else "derivatives by pressure and temperature"


def _coefficient(
    routine: Routine, values: list[float], points: int
) -> tuple[dict[str, float], Stopwatch, float]:
    """Coefficient and derivatives at scattered slip rates, pressures and temperatures."""
    from usersub import CoefficientDriver, Scene

    k = np.arange(points)
    rate = 300.0 * np.mod(0.618 * k + 0.01, 1.0)
    pressure = 100.0 + 2900.0 * np.mod(0.414 * k, 1.0)
    temperature = 50.0 + 200.0 * np.mod(0.732 * k, 1.0)
    scene = Scene(points=points, props=values, temperatures=1, derivatives=1)
    driver = CoefficientDriver(routine, scene)
    slip_data = np.zeros((6, points), order="F")
    slip_data[0] = slip_data[1] = rate
    arrays = {"slip_rate": rate, "slip_data": slip_data, "pressure": pressure,
              "temperature": temperature}  # fmt: skip
    driver.bind(**{n: a for n, a in arrays.items() if n in driver.layout.ports})
    watch = Stopwatch()
    with watch:
        mu = driver.evaluate(time_increment=1.0)
    answer, derivative = exact(rate, pressure, temperature), driver.array("derivative")
    errors = {
        "coefficient": _relative(mu, answer.mu),
        "by_rate": _relative(derivative[0], answer.by_rate),
        "by_pressure": _relative(derivative[1], answer.by_pressure),
        "by_temperature": _relative(derivative[2], answer.by_temperature),
    }
    return errors, watch, 1.0


def _rod(
    routine: Routine, values: list[float], points: int
) -> tuple[dict[str, float], Stopwatch, float]:
    """Rods that slide while pressure, slip rate, temperatures change: stress and tangents."""
    from usersub import Scene, StandardDriver

    scene = Scene(
        points=points, dimension=3, props=values, temperatures=1, temperature_tangent=1,
        characteristic_length=1.0, states=2 if routine.interface.name == "fric" else 0,
    )  # fmt: skip
    driver = StandardDriver(routine, scene, reuse=True)
    angle = np.linspace(0.2, 6.0, points)
    n = np.array([np.cos(angle), np.sin(angle)])
    motion, pressure = np.zeros((2, points), order="F"), np.zeros(points)
    warm, cold = np.zeros(points), np.zeros(points)
    known = driver.layout.ports
    extra = {"coord": np.zeros((3, points), order="F")} if "coord" in known else {}
    driver.bind(slip_increment=motion, pressure=pressure, temperature_secondary=warm,
                temperature_main=cold, **extra)  # fmt: skip
    k, watch, errors = np.arange(points), Stopwatch(), {}
    for i in range(-2, _INCREMENTS):
        dt = 0.01 * (1.0 + 0.5 * np.sin(i))
        # First one increment closes the contact, a second one brings the elastic slip to its limit.
        rate = 0.0 * k if i < 0 else 290.0 * np.mod(0.618 * (k + 7 * i) + 0.01, 1.0) + 1.0
        motion[...] = n * (rate * dt + (0.005 if i == -1 else 0.0))
        pressure[...] = 150.0 + 2800.0 * np.mod(0.414 * (k + 3 * i), 1.0)
        warm[...] = 80.0 + 200.0 * np.mod(0.732 * (k + 5 * i), 1.0)
        cold[...] = 20.0 + 150.0 * np.mod(0.541 * (k + i), 1.0)
        driver.begin_increment(dt)
        with watch:
            response = fixed.iterate(driver)
        driver.commit()
        if i >= 0:
            answer = exact(rate, pressure, 0.5 * (warm + cold))
            for name, error in _tangent_errors(response, answer, n, pressure, rate, dt).items():
                errors[name] = float(np.maximum(error, errors.get(name, 0.0)))
    return errors, watch, 0.015


def _tangent_errors(response, answer: Exact, n, pressure, rate, dt) -> dict[str, float]:
    """Errors of stress and tangents, along the sliding direction and across it."""
    stress = answer.mu * pressure
    along = np.einsum("ak,abk,bk->k", n, response.ddtddg, n)
    across = np.array([-n[1], n[0]])
    turning = np.einsum("ak,abk,bk->k", across, response.ddtddg, across)
    reach = 0.005 + rate * dt
    by_temperature = response.ddtddt.sum(1)
    return {
        "coefficient": _relative((n * response.tau).sum(0) / pressure, answer.mu),
        "direction": float(np.abs((across * response.tau).sum(0) / stress).max()),
        "by_rate": _relative(along, pressure * answer.by_rate / dt),
        "turning": _relative(turning, stress / reach),
        "by_pressure": _relative(
            (n * response.ddtddp).sum(0), answer.mu + pressure * answer.by_pressure
        ),
        "by_temperature": _relative((n * by_temperature).sum(0), pressure * answer.by_temperature),
    }


def run(
    routine: Routine,
    law: str,
    precision: str,
    method: str,
    *,
    points: int = 64,
    table_points: int = TABLE_POINTS,
) -> Outcome:
    """One run against the closed form."""
    runner = _coefficient if method == "coefficient" else _rod
    errors, watch, step = runner(routine, props(law, table_points), points)
    smooth, what = _compared(law)
    compared = [e for name, e in errors.items() if smooth or name != "by_rate"]
    return Outcome(
        problem="P4", law=law, interface=routine.interface.name, language=routine.language,
        precision=precision, method=method, step=step, points=points,
        error=float(np.max(compared)), error_of=f"coefficient and {what}",
        tolerance=TOLERANCES[law], details=errors, **watch.times(points),
    )  # fmt: skip


PROBLEM = Problem(
    name="P4",
    title="Rod with a coefficient of slip rate, pressure and temperature",
    statement="A rod is pressed on a rigid surface and slides over it while pressure, slip rate "
    "and the temperatures of both surfaces change; contact area 1. The coefficient decays from "
    "Cs T + Ds p at rest to Ck T + Dk p, or is read from a table of the same function.",
    laws=("temperature_pressure_decay", "coulomb_tabulated"),
    methods={"fric_coef": ("coefficient", "rod"), "fric": ("rod",)},
    runner=run,
    options={
        "points": "contact points",
        "table_points": "slip rates of the tabulated law's table",
    },
)
