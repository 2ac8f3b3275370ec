# SPDX-License-Identifier: MIT
"""Every law gives the same bits whatever the block size and the number of threads."""

from __future__ import annotations

from functools import cache
from itertools import cycle, islice

import law_cases
import law_host
import numpy as np
import pytest
from law_cases import column, floats

import usersub
from usersub import laws

#: A multiple of none of the block sizes.
N = 37
CHOICES = [{"block": 1, "threads": 1}, {"block": 5, "threads": 2}, {"block": N, "threads": 2}]
ALL = ("coefficient", "strength", "traction", "bristle")


@cache
def _points(law: str) -> tuple[dict, list[dict]]:
    """The first case, and N of its points with one time increment, again and again."""
    case = law_cases.reference(law)[0]
    entries = case.get("points") or case["path"]
    dt = next(float(p["time_increment"]) for p in entries if float(p["time_increment"]) > 0)
    usable = [p for p in entries if float(p["time_increment"]) == dt]
    return case, list(islice(cycle(usable), N))


def _slips(points: list[dict]) -> np.ndarray:
    """Motion of each point, shape (2, N), of its own size and direction."""
    if "motion" in points[0]:
        return floats([p["motion"] for p in points]).T
    length = column(points, "slip_rate") * column(points, "time_increment")
    length = length * np.linspace(0.5, 2.0, N) + 1e-3
    angle = np.arange(N) * 0.7
    return np.array([length * np.cos(angle), length * np.sin(angle)])


def _standard(law, interface, precision, language, **choice) -> list[np.ndarray]:
    case, points = _points(law)
    two = int(laws.law(law).anisotropic and interface == "fric_coef")
    settings = law_cases.scene_of(
        law, case, interface, points, characteristic_length=0.5, temperature_tangent=1,
        anisotropic=two, **choice,
    )  # fmt: skip
    routine = laws.routine(law, interface, language)
    driver = usersub.StandardDriver(routine, usersub.Scene(**settings))
    temperature = column(points, "temperature")
    arrays = {
        "pressure": column(points, "pressure"), "closed": np.ones(N, np.int32),
        "temperature_secondary": temperature, "temperature_main": 0.5 * temperature,
    }  # fmt: skip
    if driver.scene.fields:
        fields = np.asfortranarray(column(points, "fields"))
        arrays |= {"field_secondary": fields, "field_main": fields}
    slips = _slips(points)
    found = []
    for share in (0.0, 1.0, -0.25):
        driver.begin_increment(float(points[0]["time_increment"]))
        response = driver.iterate(slip_increment=np.asfortranarray(share * slips), **arrays)
        driver.commit()
        found += [response.tau, response.ddtddg, response.ddtddp, response.ddtddt]
    return [*found, np.array(driver.state["state"])]


def _explicit(law, interface, precision, language, **choice) -> list[np.ndarray]:
    case, points = _points(law)
    driver, surface = law_host.driver_of(
        law, interface, precision, language, case, points, **choice
    )
    slips = _slips(points)
    dt = float(points[0]["time_increment"])
    found = []
    for share in (1.0, -0.25):
        slip = share * (surface.along * slips[0] + surface.across * slips[1])
        found.append(law_host.step(driver, surface, dt, points, slip, law_host.NO_STICK))
    if "state" in driver.layout.ports:
        found.append(np.array(driver.state["state"]))
    return found


@pytest.mark.parametrize(
    ("law", "interface", "precision"),
    law_cases.combinations(law_cases.PRECISIONS, ALL),
)
def test_blocks_and_threads_give_the_same_bits(law, interface, precision, language):
    run = _explicit if interface.startswith("v") else _standard
    expected = run(law, interface, precision, language)
    for choice in CHOICES:
        found = run(law, interface, precision, language, **choice)
        for one, other in zip(expected, found, strict=True):
            assert one.tobytes() == other.tobytes(), choice
