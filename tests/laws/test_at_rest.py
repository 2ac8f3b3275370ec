# SPDX-License-Identifier: MIT
"""Laws behind FRIC at exact rest: one tangent, the same in all languages; and rates and steps whose
products are no numbers any more."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import asinh, exp, log, mp, mpf

import usersub
from usersub import laws

#: Points with motions, and pressures that stay or fall to rest, of their own.
POINTS = 24

#: Properties that are not those of the examples: where the strength changes with the rate at rest.
OTHER = {
    "elasto_plastic": {"mus": 0.5, "muk": 0.6, "vs": 4e-3, "delta": 1.0},
    "maxwell_slip": {"mus": 0.5, "muk": 0.6, "vs": 4e-3, "delta": 1.0},
    "lugre": {"delta": 1.0},
}
BRISTLES = [name for name in laws.LAWS if laws.law(name).kind == "bristle"]


def _rest(name, language, directions, extra=None):
    """Traction and derivatives at rest after three motions; `extra` is moved in the last one."""
    random = np.random.default_rng(3)
    law = laws.law(name)
    law = law(**{**law.example, **OTHER.get(name, {})})
    scene = usersub.Scene(
        points=POINTS, dimension=directions + 1, props=law.props, states=law.states("fric"),
        characteristic_length=1e-3,
    )  # fmt: skip
    driver = usersub.StandardDriver(laws.routine(name, "fric", language), scene)
    size = (directions, POINTS)
    motions = [1e-3 * random.normal(size=size) * 10.0 ** random.uniform(-3, 1) for _ in range(3)]
    pressure = 100.0 * 10.0 ** random.uniform(-0.3, 0.3, POINTS)
    fallen = np.where(np.arange(POINTS) % 3 == 0, 0.4 * pressure, pressure)
    last = np.zeros(size) if extra is None else np.broadcast_to(extra[:, np.newaxis], size)
    path = [(np.zeros(size), pressure), *((m, pressure) for m in motions), (last, fallen)]
    for motion, load in path:
        driver.begin_increment(0.02)
        found = driver.iterate(slip_increment=np.asfortranarray(motion), pressure=load)
        driver.commit()
    return found.tau, found.ddtddg, found.ddtddp


@pytest.mark.parametrize("directions", [1, 2])
@pytest.mark.parametrize("name", BRISTLES)
def test_the_tangent_at_rest_is_that_of_c(name, directions, language):
    """Within rounding of the stiffness of stick, which is the largest tangent of all points."""
    for ours, c in zip(
        _rest(name, language, directions), _rest(name, "c", directions), strict=True
    ):
        np.testing.assert_allclose(ours, c, rtol=0, atol=1e-11 * np.abs(c).max())


@pytest.mark.parametrize("name", ["elasto_plastic", "iwan", "softened"])
def test_the_tangent_at_rest_is_one_sided(name, language):
    """What a small motion by each direction from rest adds, at the points that it adds it to: those
    outside of the kinks, where stick ends within it, are nearly all."""
    step = 1e-13
    tau, tangent, _ = _rest(name, language, 2)
    good = 0
    for b in range(2):
        moved, _, _ = _rest(name, language, 2, step * np.eye(2)[b])
        change = (moved - tau) / step
        error = np.abs(change - tangent[:, b]).max(axis=0) / np.abs(tangent).max()
        good += np.count_nonzero(error < 0.02)
    assert good >= 2 * POINTS * (0.9 if name == "elasto_plastic" else 0.3)


@pytest.mark.parametrize("name", ["iwan", "softened"])
def test_what_a_slip_left_at_its_limit_sticks(name, language):
    """Rounding above or below: the tangent at rest is the stiffness at every point that slid."""
    law = laws.law(name)(**laws.law(name).example)
    stiffness = sum(law.values["stiffness"]) if name == "iwan" else law.props[1]
    scene = usersub.Scene(points=64, dimension=3, props=law.props, states=law.states("fric"))
    driver = usersub.StandardDriver(laws.routine(name, "fric", language), scene)
    angle = np.linspace(0.1, 6.0, 64)
    way = np.asfortranarray([np.cos(angle), np.sin(angle)])
    for motion in (0.0 * way, way, 0.0 * way):
        driver.begin_increment(1.0)
        found = driver.iterate(slip_increment=motion, pressure=np.full(64, 7.0))
        driver.commit()
    wanted = np.broadcast_to(stiffness * np.eye(2)[:, :, np.newaxis], (2, 2, 64))
    np.testing.assert_allclose(found.ddtddg, wanted, rtol=1e-12, atol=1e-9 * stiffness)
    assert not found.ddtddp.any()
    bound = 7.0 * law.props[0]
    assert np.hypot(*found.tau).max() <= bound * (1 + 4 * 2.0**-52)


def _regularised(rate, time_increment, theta, props):
    f0, a, b, v0, dc = (mpf(x) for x in props[:5])
    rate, x = mpf(rate), mpf(rate) * mpf(time_increment) / mpf(props[4])
    theta = dc / rate + (mpf(theta) - dc / rate) * exp(-min(x, mpf(10) ** 6))
    theta = max(theta, mpf(2.2250738585072014e-308))  # the least that a state is
    mu = a * asinh(rate / (2 * v0) * exp((f0 + b * log(v0 * theta / dc)) / a))
    return float(mu), float(theta)


@pytest.mark.parametrize(
    ("rate", "time_increment"),
    [(1e303, 1.0), (1e306, 1.0), (1e290, 1e15), (1e-3, 1e307), (1e3, 1e304)],
)
def test_rates_and_steps_that_overflow_on_the_way(rate, time_increment, language):
    """rate/(2 V0), rate dt/Dc and dt/Dc are beyond the largest number, the friction is not."""
    law = laws.rate_state_regularised(f0=0.6, a=0.02, b=0.015, V0=1e-6, Dc=1e-5, theta0=10.0)
    scene = usersub.Scene(
        points=1, dimension=2, props=law.props, states=1, characteristic_length=1e-6
    )
    driver = usersub.StandardDriver(laws.routine(law.name, "fric_coef", language), scene)
    motion = min(rate * time_increment, 1e307)
    for slip, step in ((0.0, 1e-9), (motion, time_increment)):
        driver.begin_increment(step)
        found = driver.iterate(slip_increment=np.full((1, 1), slip), pressure=np.ones(1))
        driver.commit()
    with mp.workdps(40):
        mu, theta = _regularised(motion / time_increment, time_increment, 10.0, law.props)
    assert found.tau[0, 0] == pytest.approx(mu, rel=1e-12, abs=1e-15)
    assert driver.state["state"][-1, 0] == pytest.approx(theta, rel=1e-12)
    assert np.isfinite(found.ddtddg).all()


@pytest.mark.parametrize("name", [n for n in laws.LAWS if n.startswith("rate_state")])
@pytest.mark.parametrize(("rate", "time_increment"), [(1e303, 1.0), (1e290, 1e15), (1e-3, 1e307)])
def test_rate_and_state_goes_on(name, rate, time_increment, language):
    """Derivatives are finite, and the friction is that of C to rounding of its logarithms."""
    law = laws.law(name)(**laws.law(name).example)
    answers = []
    for each in ("c", language):
        scene = usersub.Scene(
            points=1, dimension=2, props=law.props, states=law.states("fric_coef"),
            characteristic_length=1e-6,
        )  # fmt: skip
        driver = usersub.StandardDriver(laws.routine(name, "fric_coef", each), scene)
        for slip, step in ((0.0, 1e-9), (min(rate * time_increment, 1e307), time_increment)):
            driver.begin_increment(step)
            found = driver.iterate(slip_increment=np.full((1, 1), slip), pressure=np.ones(1))
            driver.commit()
        assert np.isfinite(found.ddtddg).all()
        answers.append(found.tau[0, 0])
    assert 0 <= answers[0] < 2
    assert answers[1] == pytest.approx(answers[0], rel=1e-12, abs=1e-13)
