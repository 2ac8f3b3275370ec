# SPDX-License-Identifier: MIT
"""Bristle laws behind FRIC, VFRIC and VFRICTION along the paths of their reference values."""

from __future__ import annotations

import law_cases
import law_host
import numpy as np
import pytest
from law_cases import floats

import usersub
from usersub import laws


def _rotation(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def _pressure(increment: dict) -> float:
    return float(increment["pressure"])


@pytest.mark.parametrize("turn", [0.0, 0.3], ids=["fixed directions", "turning directions"])
@pytest.mark.parametrize(
    ("law", "interface", "precision"), law_cases.combinations(("fric",), ("bristle",))
)
def test_standard(law, interface, precision, turn, language):
    # The same path in local directions that turn: everything turns with them.
    for case in law_cases.reference(law):
        n = case["directions"]
        if turn and n == 1:
            continue
        settings = law_cases.scene_of(
            law, case, interface, case["path"][:1], directions=n, dimension=n + 1,
            temperature_tangent=1, characteristic_length=1.0,
        )  # fmt: skip
        driver = usersub.StandardDriver(
            laws.routine(law, interface, language), usersub.Scene(**settings)
        )
        driver.begin_increment(1.0)
        _iterate(driver, case["path"][0], np.zeros(n), np.eye(2))
        driver.commit()
        # The scale of components that cancel: the largest of the path so far.
        largest = {"tau": 0.0, "vectors": 0.0, "scalars": 0.0}
        angle = 0.0
        for number, increment in enumerate(case["path"]):
            step = turn * (1 + number % 3)
            angle += step
            into = _rotation(angle)[:n, :n]
            motion = into @ floats(increment["motion"])[:n]
            driver.begin_increment(float(increment["time_increment"]))
            response = _iterate(driver, increment, motion, _rotation(step))
            driver.commit()
            where = (number, case["props"])
            _check_standard(driver, response, increment["double"], into, largest, law, where)
            tau = response.tau[:, 0]
            assert response.sfd[0] == pytest.approx(tau @ motion, rel=1e-13, abs=1e-300)
            assert np.array_equal(response.dslip[:, 0], motion)
            assert response.sed[0] == 0.0


def _iterate(driver, increment, motion, rotation):
    """The temperature is given to one surface, from increment to increment the other one."""
    temperature = np.array([2.0 * float(increment["temperature"])])
    fields = {}
    if driver.scene.fields:
        column = floats(increment["fields"]).reshape(-1, 1)
        fields = {"field_secondary": np.asfortranarray(2.0 * column),
                  "field_main": np.zeros_like(column, order="F")}  # fmt: skip
    return driver.iterate(
        slip_increment=np.asfortranarray(motion.reshape(-1, 1)),
        pressure=np.array([_pressure(increment)]),
        closed=np.ones(1, np.int32),
        rotation=np.asfortranarray(rotation.reshape(2, 2, 1)),
        temperature_secondary=temperature,
        temperature_main=np.zeros(1),
        **fields,
    )


def _check_standard(driver, response, wanted, into, largest, law, where):
    n = len(into)
    tau = into @ floats(wanted["traction"])[:n]
    tangent = floats(wanted["tangent"])[:n]
    vectors = floats(wanted["vectors"]).reshape(-1, 2)[:, :n] @ into.T
    scalars = floats(wanted["state"])
    state = driver.state["state"][:, 0] if driver.scene.states else np.zeros(0)
    found = {
        "tau": (response.tau[:, 0], tau),
        "vectors": (state[: vectors.size], vectors.ravel()),
        "scalars": (state[vectors.size :], scalars),
    }
    for name, (one, other) in found.items():
        largest[name] = max(largest[name], np.abs(other).max(initial=0.0))
        error = np.abs(one - other).max(initial=0.0)
        assert error <= law_cases.RELATIVE * largest[name], (name, where, one, other)
    stiffness = into @ tangent[:, :n] @ into.T
    columns = {
        "ddtddg": (response.ddtddg[:, :, 0], stiffness),
        "ddtddp": (response.ddtddp[:, 0], into @ tangent[:, 2]),
        "ddtddt": (response.ddtddt[:, 0, 0], into @ tangent[:, 3] / 2),
    }
    for name, (one, other) in columns.items():
        if np.isfinite(other).all():
            allowed = law_cases.RELATIVE * np.abs(other).max() + 1e-24
            assert np.abs(one - other).max() <= allowed, (name, where, one, other)


@pytest.mark.parametrize(
    ("law", "interface", "precision"), law_cases.combinations(("vfric", "vfriction"), ("bristle",))
)
def test_explicit(law, interface, precision, language):
    # Three points on different planes go the same path; an explicit step has a time increment.
    for case in law_cases.reference(law):
        path = case["path"]
        if case["directions"] == 1 or any(float(i["time_increment"]) == 0 for i in path):
            continue
        first = [path[0]] * 3
        driver, surface = law_host.driver_of(law, interface, precision, language, case, first)
        largest = 0.0
        for number, increment in enumerate(path):
            tolerance = law_cases.relative(law, precision, factor=number + 1.0)
            motion = floats(increment["motion"])
            slip = surface.along * motion[0] + surface.across * motion[1]
            dt = float(increment["time_increment"])
            force = law_host.step(driver, surface, dt, [increment] * 3, slip, law_host.NO_STICK)
            traction = floats(increment[precision]["traction"])
            if not _pressure(increment) > 0:
                assert not force.any()
                break  # the states of an open point stand still, those of the path do not
            wanted = -(surface.along * traction[0] + surface.across * traction[1]) * surface.area
            largest = max(largest, np.abs(traction).max())
            error = np.abs(force - wanted).max(axis=0)
            assert (error <= tolerance * largest * surface.area).all(), (number, force, wanted)
            vectors = floats(increment[precision]["vectors"]).reshape(-1, 2)
            expected = np.einsum("v,ik->vik", vectors[:, 0], surface.along)
            expected += np.einsum("v,ik->vik", vectors[:, 1], surface.across)
            states = surface.states(driver) if driver.scene.states else np.zeros((0, 3))
            kept = states[: expected.size // 3].reshape(expected.shape)
            size = np.abs(vectors).max(initial=0.0)
            assert np.abs(kept - expected).max(initial=0.0) <= 8 * tolerance * size, number
            scalars = floats(increment[precision]["state"])[:, np.newaxis]
            rest = states[expected.size // 3 :]
            assert rest == pytest.approx(np.broadcast_to(scalars, rest.shape), rel=8 * tolerance)
