# SPDX-License-Identifier: MIT
"""Friction that changes from step to step, against start + amplitude (end - start)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import usersub
from usersub import Amplitude, Change, Friction, Interaction, SceneError, laws
from usersub.interaction import changing

#: Slip is so much larger than the allowable elastic slip that each increment ends slipping.
SLIP, PRESSURE = 0.02, np.array([10.0, 125.0])
#: A product, a blend of two numbers and a division: a few roundings.
TOLERANCE = 1e-14


def scene(**settings):
    return usersub.Scene(points=2, dimension=2, characteristic_length=1.0, **settings)


class Slider:
    """Two points that slide; `run` gives the coefficients of the increments of a step."""

    def __init__(self, friction, **options):
        self.interaction = Interaction(friction, scene(), **options)
        self.slip = np.zeros((1, 2), order="F")
        self.interaction.bind(slip_increment=self.slip, pressure=PRESSURE)

    def run(self, *change, count=4, period=1.0, slip=SLIP, **options):
        one = self.interaction
        one.begin_step(period, *change, **options)
        found = []
        for _ in range(count):
            one.begin_increment(period / count)
            self.slip[...] = slip
            tau = one.iterate().tau[0]
            one.commit()
            found.append(tau / PRESSURE)
        found = np.array(found)
        np.testing.assert_allclose(found[:, 0], found[:, 1], rtol=TOLERANCE)
        return found[:, 0]


def coulomb(mu, **settings):
    return Friction(laws.coulomb(mu=mu), **settings)


def near(found, expected):
    np.testing.assert_allclose(found, expected, rtol=TOLERANCE, atol=1e-16)


def test_a_ramp_an_amplitude_removal_and_reset():
    slider = Slider(coulomb(0.3))
    near(slider.run(), [0.3] * 4)
    near(slider.run(Change(coulomb(0.1))), [0.25, 0.2, 0.15, 0.1])
    half = Amplitude(((0.0, 0.0), (1.0, 0.5)))
    near(slider.run(Change(coulomb(0.5), half)), [0.15, 0.2, 0.25, 0.3])
    near(slider.run(), [0.3] * 4)  # a change that went half way stays there
    near(slider.run(Change()), [0.225, 0.15, 0.075, 0.0])
    near(slider.run(), [0.0] * 4)
    near(slider.run(Change(reset=True)), [0.075, 0.15, 0.225, 0.3])


@pytest.mark.parametrize("method", ["elastic_slip", "stick_slope", "lagrange"])
def test_removal_keeps_how_sticking_is_enforced(method):
    """The host's scene need not know the method of a friction that is gone."""
    settings = {"enforcement": "lagrange"} if method == "lagrange" else {method: 50.0}
    if method == "elastic_slip":
        settings = {method: 1e-3}
    plain = usersub.Scene(points=2, dimension=2)
    one = Interaction(coulomb(0.3, damping=2.0, **settings), plain)
    one.bind(slip_increment=np.full((1, 2), 5.0, order="F"), pressure=PRESSURE)
    if method == "lagrange":
        one.bind(multiplier=np.zeros((1, 2), order="F"))
    for change in (None, Change()):
        one.begin_step(1.0, change, ramp=False)
        for _ in range(2):  # the first increment of Lagrange multipliers sticks
            one.begin_increment(0.5)
            tau = one.iterate().tau[0]
            one.commit()
    assert not tau.any()


def test_open_points_need_no_temperatures_that_no_law_reads():
    warm = usersub.Scene(points=2, dimension=2, characteristic_length=1.0, temperatures=1, fields=1)
    one = Interaction(coulomb(0.3), warm)
    one.bind(slip_increment=np.full((1, 2), 5.0, order="F"), pressure=PRESSURE * [1, 0])
    for change in (None, Change(coulomb(0.5))):
        one.begin_step(1.0, change)
        one.begin_increment(0.5)
        one.iterate()
        one.commit()
    one.bind(pressure=PRESSURE)
    one.begin_increment(0.5)
    near(one.iterate().tau[0], 0.5 * PRESSURE)


def test_a_step_begins_between_increments():
    slider = Slider(coulomb(0.3))
    slider.run(count=1)
    one = slider.interaction
    one.begin_step(1.0, Change(coulomb(0.5)))
    one.begin_increment(0.25)
    with pytest.raises(SceneError, match="commit or cut back"):
        one.begin_increment(0.5)  # the open one stays as long as it is
    with pytest.raises(SceneError, match="an increment is open"):
        one.begin_step(1.0)
    one.iterate()
    one.commit()
    one.begin_increment(0.25)
    near(one.iterate().tau[0], 0.4 * PRESSURE)
    one.cut_back()
    one.begin_step(1.0)


def test_friction_is_added_to_a_frictionless_interaction():
    slider = Slider(None)
    near(slider.run(), [0.0] * 4)
    near(slider.run(Change(coulomb(0.4))), [0.1, 0.2, 0.3, 0.4])


def test_a_smooth_step_between_three_points():
    slider = Slider(coulomb(0.2))
    slider.run()
    points = ((0.0, 0.0), (0.5, 0.25), (1.0, 1.0))
    found = slider.run(Change(coulomb(0.6), Amplitude(points, smooth=True)), count=8)

    def smooth(x):
        return x**3 * (10.0 - 15.0 * x + 6.0 * x * x)

    time = np.arange(1, 9) / 8
    share = np.where(time <= 0.5, 0.25 * smooth(2.0 * time), 0.25 + 0.75 * smooth(2.0 * time - 1.0))
    near(found, 0.2 + 0.4 * share)


def test_at_once_where_the_step_does_not_ramp():
    slider = Slider(coulomb(0.3), ramps={3: False})
    slider.run()
    near(slider.run(Change(coulomb(0.1)), ramp=False), [0.1] * 4)
    near(slider.run(Change(coulomb(0.7))), [0.7] * 4)


def test_the_first_step_starts_from_zero():
    slider = Slider(coulomb(0.3), changes={1: Change(coulomb(0.4))})
    near(slider.run(), [0.1, 0.2, 0.3, 0.4])


def test_the_end_is_estimated_with_the_rate_of_now():
    decay = laws.exponential_decay(mus=0.5, muk=0.1, dc=0.2)
    slider = Slider(coulomb(0.3))
    slider.run(slip=1.0)
    found = slider.run(Change(Friction(decay)), slip=1.0)
    rate = 1.0 / 0.25  # the elastic slip is at its limit: all motion is slip
    end = 0.1 + 0.4 * math.exp(-0.2 * rate)
    near(found, 0.3 + np.array([0.25, 0.5, 0.75, 1.0]) * (end - 0.3))


def test_the_allowable_elastic_slip_changes_too():
    one = Interaction(coulomb(0.3, elastic_slip=1e-3), scene())
    slip = np.zeros((1, 2), order="F")
    one.bind(slip_increment=slip, pressure=PRESSURE)
    one.begin_step()
    one.begin_increment(1.0)
    one.iterate()
    one.commit()
    one.begin_step(1.0, Change(coulomb(0.3, elastic_slip=5e-3)))
    one.begin_increment(0.5)
    slip[...] = 1e-3  # sticks: half way the allowable elastic slip is 3e-3
    near(one.iterate().tau[0], 0.3 * PRESSURE / 3.0)
    one.cut_back()
    one.begin_increment(1.0)
    near(one.iterate().tau[0], 0.3 * PRESSURE / 5.0)


@pytest.mark.parametrize(
    ("law", "first", "expected"),
    [
        ("coulomb", False, changing.GRADUAL),
        ("coulomb", True, changing.COEFFICIENT_ONLY),
        ("exponential_decay", False, changing.COEFFICIENT_ONLY),
        ("rough", False, changing.AT_ONCE),
    ],
)
def test_when_the_allowable_elastic_slip_is_new_at_once(law, first, expected):
    new = {
        "coulomb": lambda: laws.coulomb(mu=0.1),
        "exponential_decay": lambda: laws.exponential_decay(mus=0.3, muk=0.1, dc=1.0),
        "rough": laws.rough,
    }[law]()
    old = coulomb(0.3)
    assert changing.manner(old, Friction(new), first=first, at_once=False) == expected
    assert changing.manner(old, Friction(new), first=first, at_once=True) == changing.AT_ONCE


def test_to_rough_and_back():
    slider = Slider(coulomb(0.3))
    slider.run()
    one = slider.interaction
    one.begin_step(1.0, Change(Friction(laws.rough())))
    one.begin_increment(1.0)
    slider.slip[...] = 0.0
    assert list(one.iterate().lm) == [1, 1]
    one.commit()
    near(slider.run(Change(coulomb(0.2))), [0.2] * 4)


def test_state_goes_on_through_a_change():
    slider = Slider(coulomb(0.3))
    slider.run()
    before = slider.interaction.driver.state["slip"].copy()
    assert before.min() > 0.0
    slider.run(Change(coulomb(0.1)), count=1, slip=0.0)
    np.testing.assert_array_equal(slider.interaction.driver.state["slip"], before)


@pytest.mark.parametrize("temperature", [20.0, 70.0])
def test_a_point_that_closes_in_the_step_starts_from_the_old_friction_too(temperature):
    """The first point closes half way through a change that follows a change half done."""
    table = laws.coulomb_tabulated(temperatures=[20.0, 120.0], table=[0.4, 0.2])
    old = 0.4 - 0.2 * (temperature - 20.0) / 100.0
    one = Interaction(Friction(table, temperatures=1), scene())
    pressure = np.array([0.0, 10.0])
    one.bind(
        slip_increment=np.full((1, 2), SLIP, order="F"),
        pressure=pressure,
        temperature_secondary=np.full(2, temperature - 5.0),
        temperature_main=np.full(2, temperature + 5.0),
    )
    half = Amplitude(((0.0, 0.0), (1.0, 0.5)))
    for change in (None, Change(coulomb(0.1), half)):
        one.begin_step(1.0, change)
        one.begin_increment(1.0)
        one.iterate()
        one.commit()
    start = 0.5 * old + 0.5 * 0.1
    one.begin_step(1.0, Change(coulomb(0.9)))
    pressure[0] = 10.0
    one.begin_increment(0.25)
    near(one.iterate().tau[0] / 10.0, [start + 0.25 * (0.9 - start)] * 2)


def test_a_point_that_closes_half_way_has_half_of_the_change():
    one = Interaction(coulomb(0.3), scene())
    pressure = np.array([0.0, 10.0])
    one.bind(slip_increment=np.full((1, 2), SLIP, order="F"), pressure=pressure)
    for change in (None, Change(coulomb(0.1))):
        one.begin_step(1.0, change)
        one.begin_increment(0.25)
        one.iterate()
        one.commit()
    pressure[0] = 10.0
    one.begin_increment(0.25)
    near(one.iterate().tau[0] / 10.0, [0.2, 0.2])


@usersub.fric_coef(generation="2022")
def own(fCoef, fCoefDeriv, props):
    fCoef[0, 0] = props[0]


def test_a_user_routine_cannot_change():
    slider = Slider(Friction(own, props=[0.3]))
    near(slider.run(), [0.3] * 4)
    with pytest.raises(SceneError, match="user routine.*before the change"):
        slider.interaction.begin_step(1.0, Change(coulomb(0.1)))
    assert slider.interaction.step == 1
    slider = Slider(coulomb(0.3))
    with pytest.raises(SceneError, match="user routine.*after the change"):
        slider.interaction.begin_step(1.0, Change(Friction(own, props=[0.3])))


def test_explicit_friction_is_redefined_at_once():
    scene_ = usersub.Scene(points=2, nodes=6)
    one = Interaction(coulomb(0.3), scene_, solver="explicit")
    normal = np.asfortranarray([[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]])
    slip = np.asfortranarray([[0.1, 0.1], [0.0, 0.0], [0.0, 0.0]])
    one.bind(slip_increment=slip, normal=normal, normal_force=PRESSURE, stick_force=1e9 * PRESSURE)
    one.begin_step()
    near(-one.driver.step(1.0).force[0], 0.3 * PRESSURE)
    one.begin_step(1.0, Change(coulomb(0.1)))
    near(-one.driver.step(1.0).force[0], 0.1 * PRESSURE)
    with pytest.raises(SceneError, match="without an amplitude"):
        one.begin_step(1.0, Change(coulomb(0.3), Amplitude(((0.0, 0.0), (1.0, 1.0)))))


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ((), "no points"),
        (((0.0, 0.0), (0.0, 1.0)), "point 1 .* after 0"),
        (((0.0, 0.5), (1.0, 0.25)), "0.5 or more"),
        (((0.0, -0.1),), "0 to 1"),
        (((0.0, math.nan),), "finite"),
        (((0.0, 1.0, 2.0),), "pair"),
        (((0.0, "1"),), "finite numbers"),
    ],
)
def test_amplitudes_that_are_refused(points, words):
    with pytest.raises(SceneError, match=words):
        Amplitude(points)


@given(
    st.lists(st.tuples(st.floats(0.01, 10.0), st.floats(0.0, 1.0)), min_size=1, max_size=6),
    st.booleans(),
    st.floats(-1.0, 70.0),
    st.floats(0.0, 5.0),
)
def test_an_amplitude_never_falls_and_stays_within_its_values(steps, smooth, time, more):
    times = np.cumsum([dt for dt, _ in steps]).tolist()
    values = sorted(v for _, v in steps)
    curve = Amplitude(tuple(zip(times, values, strict=True)), smooth=smooth)
    first, second = curve.value(time), curve.value(time + more)
    # rounding of a + (b - a) share may pass b by an ulp
    assert values[0] - 1e-15 <= first <= second + 1e-15
    assert second <= values[-1] + 1e-15


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Friction(None, slip_tolerence=0.1), "did you mean 'slip_tolerance'"),
        (lambda: Change(coulomb(0.1), reset=True), "resets it"),
        (lambda: Interaction(None, scene(elastic_slip=0.1)), "belongs to its friction"),
        (lambda: Interaction(None, scene(), solver="implicit"), "standard, explicit"),
        (lambda: Interaction(None, scene()).begin_increment(0.1), "begin_step"),
        (lambda: Interaction(None, scene()).begin_step(0.0), "above 0"),
    ],
)
def test_refusals(make, words):
    with pytest.raises(SceneError, match=words):
        make()
