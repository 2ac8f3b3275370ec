# SPDX-License-Identifier: MIT
"""Tangential damping of FRIC_COEF: c times the slip increment over the time increment, added."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import SceneError

SLIP = np.asfortranarray([[0.02, 0.3, -0.1], [-0.01, 0.2, 0.0]])
PRESSURE = np.array([5.0, 3.0, 0.0])
METHODS = [
    {"elastic_slip": 0.05},
    {"stick_slope": 30.0},
    {"enforcement": "lagrange"},
    {"elastic_slip": 0.05, "anisotropic": 1},
]


@usersub.fric_coef
def coulomb(fCoef, props):
    fCoef[0, 0] = props[0]
    if props[1] > 0.0:
        fCoef[0, 1] = props[1]


def answer(damping, method, time_increment=0.25):
    props = [0.3, 0.5 if "anisotropic" in method else 0.0]
    scene = usersub.Scene(points=3, dimension=3, props=props, damping=damping, **method)
    driver = usersub.StandardDriver(coulomb, scene)
    driver.bind(multiplier=np.zeros((2, 3), order="F"))
    driver.begin_increment(time_increment)
    found = driver.iterate(slip_increment=SLIP, pressure=PRESSURE, closed=np.ones(3, np.int32))
    return found, driver


@pytest.mark.parametrize("method", METHODS)
def test_what_it_adds(method):
    """Stress, stiffness and dissipation, in stick and slip and without pressure; nothing else."""
    without, _ = answer(0.0, method)
    damped, driver = answer(2.0, method)
    free = np.flatnonzero(without.lm == 0)
    assert free.size == (1 if "enforcement" in method else 3)
    stress = 2.0 * SLIP / 0.25
    for p in range(3):
        part = 1.0 if p in free else 0.0  # what the host constrains does not move
        np.testing.assert_allclose(
            damped.tau[:, p], without.tau[:, p] + part * stress[:, p], rtol=1e-14
        )
        np.testing.assert_allclose(
            damped.ddtddg[:, :, p], without.ddtddg[:, :, p] + part * 8.0 * np.eye(2), rtol=1e-14
        )
        work = part * float(stress[:, p] @ SLIP[:, p])
        assert damped.sfd[p] == pytest.approx(without.sfd[p] + work, rel=1e-14)
    for name in ("ddtddp", "dslip", "sed", "lm"):
        np.testing.assert_array_equal(getattr(damped, name), getattr(without, name))
    driver.commit()
    np.testing.assert_array_equal(driver.state["committed_tau"], damped.tau)


def test_no_time_no_velocity():
    without, _ = answer(0.0, METHODS[0], time_increment=0.0)
    damped, _ = answer(2.0, METHODS[0], time_increment=0.0)
    np.testing.assert_array_equal(damped.tau, without.tau)
    np.testing.assert_array_equal(damped.sfd, without.sfd)


def test_open_points_have_none():
    scene = usersub.Scene(dimension=2, props=[0.3, 0.0], damping=2.0, elastic_slip=0.1)
    driver = usersub.StandardDriver(coulomb, scene)
    driver.begin_increment(0.1)
    found = driver.iterate(slip_increment=np.ones((1, 1)), pressure=np.zeros(1))
    assert found.lm[0] == 2 and found.tau[0, 0] == found.sfd[0] == 0.0


def test_mass_on_a_damper():
    """No friction: a spring relaxes over its damper, backward Euler: (1 + k dt/c)^-n exactly."""
    stiffness, damping, dt, place = 3.0, 2.0, 0.1, 1.0
    scene = usersub.Scene(dimension=2, props=[0.0, 0.0], damping=damping, elastic_slip=0.1)
    driver = usersub.StandardDriver(coulomb, scene)
    lost = 0.0
    for _ in range(20):
        driver.begin_increment(dt)
        motion = 0.0
        for _ in range(2):
            found = driver.iterate(slip_increment=np.array([[motion]]), pressure=np.ones(1))
            residual = -stiffness * (place + motion) - found.tau[0, 0]
            motion += residual / (stiffness + found.ddtddg[0, 0, 0])
        found = driver.iterate(slip_increment=np.array([[motion]]), pressure=np.ones(1))
        driver.commit()
        place += motion
        lost += found.sfd[0]
    factor = 1.0 / (1.0 + stiffness * dt / damping)
    assert place == pytest.approx(factor**20, rel=1e-13)
    # What the damper takes: c v^2 dt summed, a geometric series.
    rate = (factor - 1.0) / dt
    series = damping * rate**2 * dt * math.fsum(factor ** (2 * k) for k in range(20))
    assert lost == pytest.approx(series, rel=1e-13)


def test_refused_where_the_routine_gives_the_stress():
    @usersub.fric
    def nothing(LM, TAU):
        TAU[:] = 0.0

    for setting in ("damping", "stick_slope", "shear_limit"):
        scene = usersub.Scene(dimension=2, **{setting: 2.0})
        with pytest.raises(SceneError, match=f"FRIC: scene setting '{setting}' = 2: the routine"):
            usersub.StandardDriver(nothing, scene)
        scene = scene.replace(props=[0.3, 0.0])
        with pytest.raises(SceneError, match="the coefficient driver enforces nothing"):
            usersub.CoefficientDriver(coulomb, scene)
