# SPDX-License-Identifier: MIT
"""What a plan costs: time in turns, memory only for what is there."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import usersub
from usersub.driver import costs
from usersub.driver.plan import Plan
from usersub.errors import SceneError
from usersub.study.allocated import allocated, growth
from usersub.study.host_arrays import host_arrays

LAW = usersub.laws.exponential_decay(mus=0.3, muk=0.1, dc=2.0)
PROPS = (0.3, 0.1, 2.0)


@pytest.fixture
def tick(monkeypatch):
    """A clock of which every look takes a second."""
    now = iter(range(10**6))
    monkeypatch.setattr(costs, "clock", lambda: next(now))


def explicit(interface="vfriction", kind=usersub.ExplicitDriver, **settings):
    scene = usersub.Scene(**{"points": 9, "props": PROPS, "nodes": 20, **settings})
    driver = kind(LAW.behind(interface, "c"), scene)
    driver.bind(**host_arrays(driver))
    return driver


def test_calls_come_in_turns(tick):
    seen = []
    calls = {name: (lambda name=name: seen.append(name)) for name in "ab"}
    found = costs.in_turns(calls, rounds=3)
    assert "".join(seen) == "ab" + "ab" * 3
    assert found == {"a": 1.0, "b": 1.0}


def test_median_of_the_rounds_and_repeats_of_quick_calls(monkeypatch):
    now, lengths = [0.0], iter([1e-3, 5.0, 1.0, 2.0, 3.0, 9.0, 4.0])

    def clock():
        return now[0]

    def call():
        now[0] += next(lengths)

    monkeypatch.setattr(costs, "clock", clock)
    assert costs.in_turns({"": call}, rounds=3) == {"": 3.0}  # of 3, 2.5, 6.5: two calls each


def test_plan_has_time_once_it_was_measured(tick):
    driver = explicit()
    plan = driver.plan
    assert plan.time is None and "time per contact point" not in plan.explain()
    measured = plan.measure()
    assert measured.time == pytest.approx((1e9 / 9, 1e9 / 9))
    assert replace(measured, time=None) == plan
    assert measured.explain().startswith(plan.explain())
    assert measured.explain().endswith(
        "time per contact point: 1.11e+08 ns, 1.11e+08 ns if everything were passed (1 times as "
        "long)"
    )


def test_a_plan_of_its_own_cannot_be_measured():
    with pytest.raises(SceneError, match=r"no driver; expected one from `driver\.plan`"):
        Plan("", (), 1, 1).measure()


def test_measuring_leaves_the_driver_alone(tick):
    driver = explicit(states=2, dissipation=1)
    nodal = np.ones((3, 20), order="F")
    force = np.zeros((3, 9), order="F")
    driver.step(0.1, nodal_force=nodal, force=force)
    before = [driver.save_state(), nodal.tobytes(), force.tobytes()]
    driver.plan.measure()
    assert [driver.save_state(), nodal.tobytes(), force.tobytes()] == before
    driver.step(0.1)
    assert driver.save_state() != before[0]


@pytest.mark.parametrize("began", [False, True])
def test_standard_drivers_are_measured_in_and_out_of_an_increment(tick, began):
    scene = usersub.Scene(points=5, props=PROPS, characteristic_length=1.0)
    driver = usersub.StandardDriver(LAW.behind("fric", "c"), scene)
    driver.bind(**host_arrays(driver))
    if began:
        driver.begin_increment(0.1)
        driver.iterate()
    assert driver.plan.measure().time is not None
    if began:
        driver.commit()


def test_missing_arrays_are_named(tick):
    driver = explicit()
    driver.bind(stick_force=None)
    with pytest.raises(SceneError, match="'stick_force' is not bound"):
        driver.plan.measure()


# Memory.

POINTS = 50_000


def memory(driver_of, **settings) -> float:
    """Bytes per contact point that a driver has after its first call."""
    probe = driver_of(points=POINTS, **settings)
    arrays = host_arrays(probe)
    kind, routine, scene = type(probe), probe.routine, probe.scene

    def called():
        driver = kind(routine, scene)
        driver.bind(**arrays)
        costs.prepared(driver)
        return driver

    return growth(called)[1] / POINTS


def coefficient(**settings):
    return explicit("vfric_coef", usersub.CoefficientDriver, **settings)


def standard(interface, **settings):
    scene = usersub.Scene(props=PROPS, characteristic_length=1.0, **settings)
    return usersub.StandardDriver(LAW.behind(interface, "c"), scene)


def vfric(**settings):
    return explicit("vfric", secondary_nodes=POINTS, main_nodes=POINTS, **settings)


def vfric_coef(**settings):
    return explicit("vfric_coef", **settings)


#: Driver, settings, doubles and integers a point that nobody can do without.
NEEDED = [
    (coefficient, {}, 1, 0),  # coefficient
    (explicit, {}, 3, 0),  # force
    (explicit, {"states": 2}, 3 + 2, 0),  # no copy of a state that the routine does not use
    (vfric_coef, {}, 3 + 1, 0),  # force, coefficient
    (vfric_coef, {"dimension": 2}, 2 + 1, 0),
    (vfric_coef, {"contact": "edge-to-edge", "temperatures": 1, "fields": 3}, 3 + 1, 0),
    (vfric, {}, 3 + 2 + 3 + 3, 0),  # force; one call: answer, length of the slip, directions
    (vfric, {"dimension": 2}, 2 + 1 + 2 + 2, 0),
]


@pytest.mark.skipif(math.isnan(allocated()), reason="the C library does not tell")
@pytest.mark.parametrize(("driver", "settings", "doubles", "integers"), NEEDED)
def test_memory_is_what_the_scene_has(driver, settings, doubles, integers):
    needed = 8 * doubles + 4 * integers
    assert needed <= memory(driver, **settings) < needed + 1.0


@pytest.mark.skipif(math.isnan(allocated()), reason="the C library does not tell")
@pytest.mark.parametrize("interface", ["fric", "fric_coef"])
def test_what_a_standard_scene_has_not_takes_no_memory(interface):
    def of(**settings):
        return memory(lambda **given: standard(interface, **given), **settings)

    least = of(dimension=2, tangent=0)
    tangents = 8 * (1 + 1)  # by motion, by pressure
    assert of(dimension=2) - least == pytest.approx(tangents, abs=0.5)
    assert of(dimension=2, tangent=0, states=3) - least == pytest.approx(2 * 24, abs=0.5)
    heat = of(dimension=2, tangent=0, temperature_tangent=1) - least
    assert heat == pytest.approx(16, abs=0.5)
