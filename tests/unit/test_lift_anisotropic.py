# SPDX-License-Identifier: MIT
"""FRIC of anisotropic law functions against the driver's own enforcement of FRIC_COEF, which is
written independently in C: random paths, frictionless directions, jumps, turned surfaces."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import usersub
from usersub.errors import RoutineError

LENGTH = 2.0
C = 0.005 * LENGTH
DT = 0.05


@usersub.coefficient(props=4)
def falling(slip_rate, pressure, props):
    """Both fall with the slip rate, at their own pace."""
    return (
        props[0] * (1.0 + math.exp(-slip_rate)) + 1e-4 * pressure,
        props[1] / (1.0 + props[2] * slip_rate),
    )


@usersub.coefficient(props=4, states=1)
def worn(slip_increment, state, props):
    state[0] = state[0] + slip_increment
    return props[0] + props[2] * state[0], props[1] * (1.0 - props[3] * math.tanh(state[0]))


@usersub.coefficient(props=4)
def jumping(slip_rate, props):
    if slip_rate < props[2]:
        return props[0], props[1]
    else:
        return props[1], props[0]


def drivers(law, props):
    """Behind FRIC and behind FRIC_COEF."""
    found = []
    for interface in ("fric", "fric_coef"):
        scene = usersub.Scene(
            points=1, dimension=3, props=props, characteristic_length=LENGTH,
            anisotropic=int(interface == "fric_coef"), states=law.states(interface),
        )  # fmt: skip
        found.append(usersub.StandardDriver(law.behind(interface), scene))
    return found


#: One driver a law, so that each is compiled once.
LAWS = {"falling": falling, "worn": worn, "jumping": jumping}


def follow(law, props, path):
    """Compares every increment; a tangent at a jump or a fold is left out."""
    results = [[], []]
    for driver, kept in zip(drivers(law, props), results, strict=True):
        is_fric = "fric" in driver.routine.interface.key and not driver.scene["anisotropic"]
        if is_fric:
            driver.begin_increment(1.0)
            iterate(driver, (0.0, 0.0), 1.0, 0.0)
            driver.commit()
        for motion, pressure, turn in path:
            driver.begin_increment(DT)
            kept.append(iterate(driver, motion, pressure, turn))
            driver.commit()
    reach = max(abs(m) for motion, _, _ in path for m in motion)
    for own, driven in zip(*results, strict=True):
        # At rest after a slip, one may find the elastic slip a rounding beyond its limit.
        slip = 1e-15 * reach
        rounding = {"dslip": slip, "sfd": slip * float(np.abs(driven.tau).max())}
        for name in ("tau", "dslip", "ddtddg", "ddtddp", "sed", "sfd"):
            a, b = getattr(own, name), getattr(driven, name)
            # Both stop at rounding of the excess, which enters the tangent with its curvature.
            size = 1e-10 * (1e-30 + np.abs(b).max()) + rounding.get(name, 0.0)
            np.testing.assert_allclose(a, b, rtol=1e-8, atol=size, err_msg=name)


def iterate(driver, motion, pressure, turn):
    c, s = math.cos(turn), math.sin(turn)
    return driver.iterate(
        slip_increment=np.array(motion).reshape(2, 1),
        pressure=np.array([float(pressure)]),
        rotation=np.array([[c, -s], [s, c]]).reshape(2, 2, 1).copy(order="F"),
    )


MOTION = st.floats(-30 * C, 30 * C)
STEP = st.tuples(st.tuples(MOTION, MOTION), st.floats(1.0, 500.0), st.floats(-3.0, 3.0))


@pytest.mark.parametrize("name", ["falling", "worn"])
@given(
    path=st.lists(STEP, min_size=1, max_size=3),
    mu=st.tuples(st.floats(0.01, 1.0), st.floats(0.01, 1.0)),
    rest=st.tuples(st.floats(0.0, 0.5), st.floats(0.0, 0.5)),
)
def test_fric_enforces_as_the_driver_does(name, path, mu, rest):
    follow(LAWS[name], [*mu, *rest], path)


@pytest.mark.parametrize("mu", [(0.3, 0.0), (0.0, 0.3), (0.0, 0.0), (0.3, 0.3), (1e-12, 0.4)])
def test_frictionless_directions(mu):
    path = [((0.3 * C, 0.2 * C), 80.0, 0.0), ((5 * C, -9 * C), 120.0, 0.3), ((C, C), 50.0, 0.0)]
    follow(worn, [*mu, 0.0, 0.5], path)


@pytest.mark.parametrize("size", [0.9, 1.5, 4.0, 60.0])
def test_coefficients_that_jump(size):
    follow(jumping, [0.6, 0.2, 2.0, 0.0], [((size * C, 0.4 * size * C), 100.0, 0.0)])


def test_isotropic_pairs_are_the_isotropic_law():
    @usersub.coefficient(props=1)
    def one(slip_rate, props):
        return props[0] * (1.0 + math.exp(-slip_rate))

    @usersub.coefficient(props=1)
    def two(slip_rate, props):
        mu = props[0] * (1.0 + math.exp(-slip_rate))
        return mu, mu

    found = []
    for law in (one, two):
        scene = usersub.Scene(
            points=1, dimension=3, props=[0.2], characteristic_length=LENGTH, states=2
        )
        driver = usersub.StandardDriver(law.fric, scene)
        driver.begin_increment(1.0)
        iterate(driver, (0.0, 0.0), 1.0, 0.0)
        driver.commit()
        driver.begin_increment(DT)
        found.append(iterate(driver, (4 * C, -2 * C), 70.0, 0.2))
    for name in ("tau", "dslip", "ddtddg", "ddtddp", "sed", "sfd"):
        a, b = (getattr(f, name) for f in found)
        np.testing.assert_allclose(a, b, rtol=1e-12, atol=1e-13 * np.abs(a).max(), err_msg=name)


def test_a_negative_coefficient_is_refused():
    @usersub.coefficient
    def wrong(slip_rate):
        return 0.1, -0.1 * slip_rate

    driver = drivers(wrong, [])[0]
    driver.begin_increment(1.0)
    iterate(driver, (0.0, 0.0), 1.0, 0.0)
    driver.commit()
    driver.begin_increment(DT)
    with pytest.raises(RoutineError, match="returns a coefficient below zero"):
        iterate(driver, (9 * C, 0.0), 1.0, 0.0)


def test_with_one_direction_the_first_coefficient_counts():
    scene = usersub.Scene(
        points=1, dimension=2, props=[0.2, 0.4, 0.0, 0.0], characteristic_length=1
    )
    for interface, states in (("fric", 1), ("fric_coef", 0)):
        driver = usersub.StandardDriver(falling.behind(interface), scene.replace(states=states))
        for _ in range(2):
            driver.begin_increment(DT)
            found = driver.iterate(slip_increment=np.array([[1e3]]), pressure=np.array([10.0]))
            driver.commit()
        assert found.tau[0, 0] == pytest.approx(10.0 * (0.2 + 1e-3), rel=1e-12)
