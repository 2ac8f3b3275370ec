# SPDX-License-Identifier: MIT
"""Rough friction: sticking is asked for, or enforced by the stick force, whatever the pressure."""

from __future__ import annotations

import law_host
import numpy as np
import pytest

import usersub
from usersub import laws
from usersub.errors import LoadError

N = 5


@pytest.mark.parametrize("pressure", [900.0, 0.0])
def test_fric_asks_for_sticking(pressure, language):
    scene = usersub.Scene(points=N, dimension=3)
    driver = usersub.StandardDriver(laws.routine("rough", "fric", language), scene)
    motion = np.asfortranarray(np.arange(2.0 * N).reshape(2, N) - 3.0)
    for _ in range(2):  # also in the increment that closes the point
        driver.begin_increment(0.25)
        response = driver.iterate(
            slip_increment=motion,
            pressure=np.full(N, pressure),
            closed=np.ones(N, np.int32),
        )
        assert (response.lm == 1).all()
        driver.commit()


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_explicit_force_is_the_stick_force(interface, precision, language):
    case = {"props": []}
    points = [
        {"pressure": p, "temperature": 0.0, "fields": []} for p in (900.0, 0.0, 3.0, 1e6, 0.5)
    ]
    driver, surface = law_host.driver_of("rough", interface, precision, language, case, points)
    stick = np.array([3.0, 70.0, 0.0, 1e9, 0.25])
    slip = surface.along * np.array([1.0, 0.5, 2.0, 1e3, 1e-3])
    force = law_host.step(driver, surface, 0.25, points, slip, stick)
    assert force == pytest.approx(-surface.along * stick, rel=1e-6)


@pytest.mark.parametrize("interface", ["fric_coef", "vfric_coef"])
def test_no_coefficient_carries_it(interface):
    with pytest.raises(LoadError, match="does not stand behind"):
        laws.routine("rough", interface)
