# SPDX-License-Identifier: MIT
"""Coefficient, strength and traction laws behind FRIC and FRIC_COEF against arbitrary precision."""

from __future__ import annotations

from functools import cache, cached_property

import law_cases
import law_return
import numpy as np
import pytest
import reference
from law_cases import floats
from law_return import Increment, Memory
from mpmath import cos, mpf, sin, workdps

import usersub
from usersub import laws

#: Exact in binary, so that the reference has the same allowable elastic slip to a rounding.
LENGTH = 0.5
KINDS = ("coefficient", "strength", "traction")


def _angle(point: int) -> float:
    return 0.4 + 1.1 * point


def motions(points: list[dict], allowable: float, directions: int) -> list[np.ndarray]:
    """Motion of all points by increment, shape (2, N): stick, slip at about the rate of the case,
    back into stick, slip across, twice in a row."""
    angle = np.array([_angle(k) for k in range(len(points))])
    if directions == 1:
        angle = np.where(np.cos(angle) > 0, 0.0, np.pi)
    rate = floats([p["slip_rate"] for p in points])
    dt = floats([p["time_increment"] for p in points])
    slip = rate * dt

    def along(length, turn):
        turn = turn if directions == 2 else np.round(turn / np.pi) * np.pi
        vector = length * np.array([np.cos(angle + turn), np.sin(angle + turn)])
        return vector if directions == 2 else vector * np.array([[1.0], [0.0]])

    ones = np.ones_like(slip)
    return [
        along(0.375 * allowable * ones, 0.0),
        along(slip + 1.5 * allowable, 0.25),
        along(-0.5 * allowable * ones, 0.5),
        along(0.5 * slip + 2.25 * allowable, 1.9),
        along(2.0 * slip + 0.125 * allowable, -1.0),
    ]


#: Rotation of the local directions by increment, and factors of the pressure.
TURNS = (0.0, 0.0, 0.25, -0.5, 0.0)
PRESSURES = (1.0, 1.0, 0.75, 1.25, 1.0)


def _turned(vector: tuple, turn: float, directions: int) -> tuple:
    if directions == 1:
        return vector
    c, s = (mpf(float(f(turn))) for f in (cos, sin))
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]


class Expected:
    """Results of all points of a case in one increment, shape (entries, N) each."""

    def __init__(self, update: law_return.ReturnMap, directions: int):
        self.update, self.directions = update, directions
        self.begun: list[tuple[Memory, Increment]] = []
        self.ends: list[law_return.End] = []

    def add(self, start: Memory, increment: Increment) -> Memory:
        """Adds a point; returns what it keeps."""
        self.begun.append((start, increment))
        self.ends.append(self.update.with_tangent(start, increment))
        return self.ends[-1].memory

    @cached_property
    def exact(self) -> dict[str, np.ndarray]:
        """The results by name."""
        return _arrays([_groups(end, self.directions) for end in self.ends])

    @cached_property
    def spread(self) -> dict[str, np.ndarray]:
        """How much each result changes when the motion is rounded."""
        rows = []
        with workdps(law_return.DIGITS):
            for (start, increment), end in zip(self.begun, self.ends, strict=True):
                here = _groups(end, self.directions)
                row = {name: [mpf(0)] * len(values) for name, values in here.items()}
                for moved in self.update.moved(start, increment):
                    there = _groups(self.update.with_tangent(start, moved), self.directions)
                    for name, sums in row.items():
                        pairs = zip(here[name], there[name], strict=True)
                        row[name] = [s + abs(b - a) for s, (a, b) in zip(sums, pairs, strict=True)]
                rows.append(row)
        return _arrays(rows)


def _arrays(rows: list[dict[str, list]]) -> dict[str, np.ndarray]:
    return {name: np.array([row[name] for row in rows], dtype=float).T for name in rows[0]}


@cache
def expected(law: str, interface: str, number: int, dt: float, directions: int) -> list[Expected]:
    """The results of all points of a case by increment."""
    described = laws.law(law)
    case = law_cases.reference(law)[number]
    points = [p for p in case["points"] if float(p["time_increment"]) == dt]
    moved = motions(points, 0.005 * LENGTH, directions)
    with workdps(law_return.DIGITS):
        props = [mpf(float(p)) for p in case["props"]]
        update = law_return.ReturnMap(described, props, mpf("0.005") * mpf(LENGTH), directions)
        found = [Expected(update, directions) for _ in TURNS]
        for k, point in enumerate(points):
            memory = Memory(state=(mpf(0),) * described.count(props)[1])
            if interface == "fric_coef":  # is asked in the increment that closes the point, too
                closing = _increment(point, np.zeros(2), 1.0)
                memory = Memory(state=update.end(memory, closing).memory.state)
            for i, motion in enumerate(moved):
                turned = _turned(memory.elastic, TURNS[i], directions)
                increment = _increment(point, motion[:, k], PRESSURES[i])
                memory = found[i].add(Memory(turned, memory.state), increment)
    return found


def _increment(point: dict, motion: np.ndarray, pressure: float) -> Increment:
    """An increment at a point of a case, with `pressure` times its pressure."""
    return Increment(
        motion=tuple(mpf(float(x)) for x in motion),
        pressure=mpf(float(point["pressure"]) * pressure),
        temperature=mpf(float(point["temperature"])),
        fields=tuple(mpf(float(f)) for f in point["fields"]),
        time_increment=mpf(float(point["time_increment"])),
    )


def _groups(end: law_return.End, directions: int) -> dict[str, list]:
    """Results by name."""
    n, tangent = directions, end.tangent
    return {
        "tau": list(end.tau[:n]),
        "dslip": list(end.dslip[:n]),
        "elastic": list(end.memory.elastic[:n]),
        "scalars": list(end.memory.state),
        "sed": [end.sed],
        "sfd": [end.sfd],
        "ddtddg": [tangent[f"motion {b + 1}"][a] for a in range(n) for b in range(n)],
        "ddtddp": list(tangent["pressure"][:n]),
        "ddtddt": [t / 2 for t in tangent["temperature"][:n]],
    }


def driven(driver, points, directions, dt):
    """Closes the points, then yields the driver's results of each increment."""
    moved = motions(points, 0.005 * LENGTH, directions)
    pressure = floats([p["pressure"] for p in points])
    temperature = floats([p["temperature"] for p in points])
    odd = np.arange(len(points)) % 2
    arrays = {
        # Only the mean counts: alternately one surface has all of it.
        "temperature_secondary": 2.0 * temperature * odd,
        "temperature_main": 2.0 * temperature * (1 - odd),
        "closed": np.ones(len(points), np.int32),
    }
    if driver.scene.fields:
        fields = floats([p["fields"] for p in points]).T
        arrays["field_secondary"] = np.asfortranarray(2.0 * fields * (1 - odd))
        arrays["field_main"] = np.asfortranarray(2.0 * fields * odd)
    zero = np.zeros((directions, len(points)), order="F")
    driver.begin_increment(dt)
    driver.iterate(slip_increment=zero, pressure=pressure, **arrays)
    driver.commit()
    for i, motion in enumerate(moved):
        c, s = float(cos(TURNS[i])), float(sin(TURNS[i]))
        rotation = np.array([[c, -s], [s, c]]) if directions == 2 else np.eye(2)
        arrays["rotation"] = np.asfortranarray(
            np.repeat(rotation[:, :, np.newaxis], len(points), axis=2)
        )
        driver.begin_increment(dt)
        response = driver.iterate(
            slip_increment=np.asfortranarray(motion[:directions]),
            pressure=pressure * PRESSURES[i],
            **arrays,
        )
        driver.commit()
        yield response


def _check(found: np.ndarray, wanted: Expected, name: str, scale: np.ndarray) -> None:
    """Relative to the scale of the point, plus what rounding of the motion makes."""
    error = np.abs(found - wanted.exact[name].reshape(found.shape))
    # What is exactly zero comes out of the differences as their step.
    allowed = np.broadcast_to(law_cases.RELATIVE * scale + 1e-20, found.shape)
    if not (error <= allowed).all():
        allowed = allowed + 8 * wanted.spread[name].reshape(found.shape)
    assert (error <= allowed).all(), (name, (error / allowed).max())


def _compare(driver, response, wanted: Expected, law: str, pressure: np.ndarray) -> None:
    n = wanted.directions
    found = {
        "tau": response.tau,
        "dslip": response.dslip,
        "sed": response.sed[np.newaxis],
        "sfd": response.sfd[np.newaxis],
        "ddtddg": response.ddtddg.reshape(n * n, -1, order="C"),
        "ddtddp": response.ddtddp,
        "ddtddt": response.ddtddt[:, 0],
    }
    assert np.array_equal(response.ddtddt[:, 0], response.ddtddt[:, 1])
    state = driver.state["state"] if driver.scene.states else np.zeros((0, driver.points))
    if driver.routine.interface.name == "fric_coef":
        found |= {"elastic": driver.array("elastic_slip"), "scalars": state}
    elif laws.law(law).kind == "traction":
        found["scalars"] = state
    else:
        found |= {"elastic": state[:n], "scalars": state[n:]}
    size = {k: np.abs(v).max(axis=0, initial=0.0) for k, v in wanted.exact.items()}
    # Along the slip Coulomb friction has no stiffness: relative to the secant. A limit on the
    # stress makes mu + p d(mu)/dp a sum that is zero: relative to mu.
    secant = size["tau"] / np.maximum(size["dslip"] + size["elastic"], 1e-300)
    mu = np.where(pressure > 0, size["tau"] / np.maximum(pressure, 1e-300), 0.0)
    larger = {"ddtddg": secant, "dslip": size["elastic"], "ddtddp": mu}
    for name, array in found.items():
        _check(array, wanted, name, np.maximum(size[name], larger.get(name, 0.0)))


@pytest.mark.parametrize("directions", [2, 1], ids=["two directions", "one direction"])
@pytest.mark.parametrize(
    ("law", "interface", "precision"), law_cases.combinations(("fric", "fric_coef"), KINDS)
)
def test_return_mapping(law, interface, precision, directions, language):
    states = bool(laws.law(law).states)  # without any, both interfaces give the same
    for number, case in enumerate(law_cases.reference(law)):
        for dt, points in law_cases.by_time_increment(case["points"]):
            if dt == 0 and laws.law(law).kind == "traction":
                continue  # refused, see test_protocol
            settings = law_cases.scene_of(
                law, case, interface, points, directions=directions, dimension=directions + 1,
                characteristic_length=LENGTH, temperature_tangent=1,
                anisotropic=int(
                    laws.law(law).anisotropic and interface == "fric_coef" and directions == 2
                ),
            )  # fmt: skip
            driver = usersub.StandardDriver(
                laws.routine(law, interface, language), usersub.Scene(**settings)
            )
            wanted = expected(law, interface if states else "fric", number, dt, directions)
            results = driven(driver, points, directions, dt)
            for increment, response in zip(wanted, results, strict=True):
                pressure = floats([p["pressure"] for p in points])
                _compare(driver, response, increment, law, pressure)


def test_reference_of_the_harness_has_the_modes():
    """The path of the tests above sticks, slips, sticks and slips again."""
    slips = [
        np.abs(i.exact["dslip"]).max(axis=0) > 0 for i in expected("coulomb", "fric", 0, 0.25, 2)
    ]
    assert [bool(s.any()) for s in slips] == [False, True, False, True, True]
    assert slips[1].all() and slips[3].all()
    assert reference.DIGITS > law_return.DIGITS
