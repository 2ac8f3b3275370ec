# SPDX-License-Identifier: MIT
"""Changing friction: from the values at the start of the step to the routine's, by an amplitude."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import ContractError, SceneError

POINTS = 3
SLIP = np.asfortranarray([[0.02, 0.3, -0.1], [-0.01, 0.2, 0.05]])
PRESSURE = np.array([5.0, 3.0, 4.0])


@usersub.fric_coef
def decay(fCoef, fCoefDeriv, slipData, pressure, props):
    """Exponential decay, weakening with pressure; props[4] > 0: a second coefficient, as large."""
    weight = math.exp(-props[2] * slipData[0, 0])
    by_pressure = 1.0 - props[3] * pressure[0]
    for k in range(2 if props[4] > 0.0 else 1):
        factor = props[4] if k else 1.0
        fCoef[0, k] = factor * (props[1] + (props[0] - props[1]) * weight) * by_pressure
        fCoefDeriv[0, 0, k] = -factor * props[2] * (props[0] - props[1]) * weight * by_pressure
        fCoefDeriv[0, 1, k] = -factor * props[3] * (props[1] + (props[0] - props[1]) * weight)


@usersub.fric_coef
def blend(fCoef, fCoefDeriv, slipData, pressure, props):
    """`decay` on the way from a constant start: props[5] amplitude, props[6:8] start."""
    weight = math.exp(-props[2] * slipData[0, 0])
    by_pressure, by = 1.0 - props[3] * pressure[0], props[5]
    for k in range(2 if props[4] > 0.0 else 1):
        factor = props[4] if k else 1.0
        value = factor * (props[1] + (props[0] - props[1]) * weight) * by_pressure
        fCoef[0, k] = (1.0 - by) * props[6 + k] + by * value
        fCoefDeriv[0, 0, k] = by * (
            -factor * props[2] * (props[0] - props[1]) * weight * by_pressure
        )
        fCoefDeriv[0, 1, k] = by * (
            -factor * props[3] * (props[1] + (props[0] - props[1]) * weight)
        )


FIRST = [0.3, 0.3, 0.0, 0.0]
SECOND = [0.7, 0.4, 2.0, 0.02]
METHODS = {
    "penalty": {"elastic_slip": 0.05},
    "softened": {"stick_slope": 25.0},
    "lagrange": {"enforcement": "lagrange"},
    "anisotropic": {"elastic_slip": 0.05, "anisotropic": 1},
}


def driver(props, method, routine=decay, **settings):
    second = 1.5 if method.get("anisotropic") else 0.0
    props = [*props[:4], second, *props[4:]]
    scene = usersub.Scene(points=POINTS, dimension=3, props=props, **method, **settings)
    made = usersub.StandardDriver(routine, scene)
    made.bind(slip_increment=SLIP, pressure=PRESSURE, multiplier=np.zeros((2, POINTS), order="F"))
    return made


def increment(made, step=1, slip=1.0, **named):
    made.begin_increment(0.25, step=step, **named)
    found = made.iterate(slip_increment=np.asfortranarray(slip * SLIP))
    # A second iteration, so that points with multipliers slip as well.
    made.array("multiplier")[...] = 9.0 * SLIP / np.abs(SLIP).max()
    for _ in range(2):
        found = made.iterate()
    made.commit()
    return found


def after_first(method, **settings):
    """A driver of the second step whose first one ran with the first friction."""
    one = driver(FIRST, method)
    increment(one)
    two = driver(SECOND, method, changing=1, **settings)
    two.state.load(one.state.save())
    return two


@pytest.mark.parametrize("amplitude", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS.keys())
def test_as_a_law_that_is_the_blend(method, amplitude):
    """Everything, tangents included, is that of the law (1 - a) start + a mu."""
    made = after_first(method)
    start = [0.3, 0.45] if method.get("anisotropic") else [0.3, 0.3]
    np.testing.assert_allclose(made.state["committed_coefficient"], np.outer(start, [1] * 3))
    own = driver([*SECOND, amplitude, *start], method, routine=blend)
    own.state.load(made.state.save())
    for number in range(1, 3):
        found = increment(made, step=2, slip=0.47 * number, amplitude=amplitude)
        expected = increment(own, step=2, slip=0.47 * number)
        for name in ("tau", "ddtddg", "ddtddp", "dslip", "sed", "sfd", "lm"):
            np.testing.assert_allclose(
                getattr(found, name), getattr(expected, name), rtol=1e-13, atol=1e-15, err_msg=name
            )
        np.testing.assert_allclose(made.array("coefficient"), own.array("coefficient"), rtol=1e-15)


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS.keys())
def test_done_is_as_not_changing(method):
    """With an amplitude of 1, the default, bit for bit the routine's own friction."""
    made, own = after_first(method), driver(SECOND, method)
    own.state.load(made.state.save())
    for slip in (1.0, -0.4, 0.1):
        found, expected = increment(made, step=2, slip=slip), increment(own, step=2, slip=slip)
        for name in ("tau", "ddtddg", "ddtddp", "dslip"):
            np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))


def test_first_step_starts_from_zero():
    made = driver(SECOND, METHODS["penalty"], changing=1)
    own = driver(SECOND, METHODS["penalty"])
    found = increment(made, amplitude=0.25)
    expected = increment(own)
    np.testing.assert_allclose(found.tau, 0.25 * expected.tau, rtol=1e-14)
    # The allowable elastic slip has no value to start from: it is the new one at once.
    np.testing.assert_array_equal(found.dslip, expected.dslip)
    np.testing.assert_array_equal(made.state["start_coefficient"], 0.0)


def test_start_is_frozen():
    made = after_first(METHODS["penalty"])
    for amplitude in (0.2, 0.5, 0.8):
        increment(made, step=2, amplitude=amplitude)
        np.testing.assert_array_equal(made.state["start_coefficient"], 0.3)
        np.testing.assert_array_equal(
            made.state["committed_coefficient"], made.array("coefficient")
        )
    last = made.array("coefficient").copy()
    increment(made, step=3, amplitude=0.0)
    np.testing.assert_array_equal(made.array("coefficient"), last)
    np.testing.assert_array_equal(made.state["start_coefficient"], last)


def test_open_points_keep_their_coefficient():
    made = after_first(METHODS["penalty"])
    made.bind(pressure=np.array([5.0, 0.0, 4.0]))
    increment(made, step=2, amplitude=0.5)
    kept = made.state["committed_coefficient"][0]
    assert made.array("coefficient")[0, 1] == 0.0 and kept[1] == 0.3
    assert kept[0] != 0.3 != kept[2]


def test_host_may_set_the_start():
    """Points that were never closed start from zero, unless the host gives them a coefficient."""
    made = driver(SECOND, METHODS["penalty"], changing=1)
    made.state["committed_coefficient"][0] = [0.1, 0.2, 0.3]
    increment(made, amplitude=0.0)
    np.testing.assert_array_equal(made.array("coefficient")[0], [0.1, 0.2, 0.3])


@pytest.mark.parametrize(("changing", "amplitude"), [(1, 0.0), (1, 0.5), (1, 1.0), (2, 0.5)])
def test_allowable_elastic_slip(changing, amplitude):
    one = driver(FIRST, {"elastic_slip": 0.05})
    increment(one)
    np.testing.assert_array_equal(one.state["committed_allowable"], 0.05)
    two = driver(FIRST, {"elastic_slip": 0.11}, changing=changing)
    two.state.load(one.state.save())
    expected = 0.05 + amplitude * 0.06 if changing == 1 else 0.11
    increment(two, step=2, slip=20.0, amplitude=amplitude)
    elastic = np.linalg.norm(two.state["elastic_slip"], axis=0)
    np.testing.assert_allclose(elastic, expected, rtol=1e-14)
    np.testing.assert_allclose(two.state["committed_allowable"], expected, rtol=1e-14)
    np.testing.assert_array_equal(two.state["start_allowable"], 0.05)
    increment(two, step=2, slip=20.0)
    np.testing.assert_allclose(np.linalg.norm(two.state["elastic_slip"], axis=0), 0.11, rtol=1e-14)


def test_no_commit_no_trace():
    """Only a commit freezes the start: a step that is tried and cut back never was."""
    made = after_first(METHODS["penalty"])
    before = made.state.save()
    for step in (2, 5):
        made.begin_increment(0.25, step=step, amplitude=0.7)
        made.iterate()
        made.cut_back()
        assert made.state.save() == before


@pytest.mark.parametrize("amplitude", [-1e-9, 1.0 + 1e-9, math.nan, math.inf])
def test_amplitudes_out_of_range(amplitude):
    made = after_first(METHODS["penalty"])
    with pytest.raises(SceneError, match="amplitude .*expected 0 to 1"):
        made.begin_increment(0.1, amplitude=amplitude)
    made.begin_increment(0.1)


def test_refusals():
    made = driver(FIRST, METHODS["penalty"])
    with pytest.raises(SceneError, match="amplitude needs the scene setting 'changing'"):
        made.begin_increment(0.1, amplitude=0.5)
    with pytest.raises(SceneError, match="'changing' = 3; expected 0, 1 or 2"):
        driver(FIRST, METHODS["penalty"], changing=3)
    with pytest.raises(SceneError, match="amplitude = 'half'; expected a real number"):
        after_first(METHODS["penalty"]).begin_increment(0.1, amplitude="half")

    @usersub.fric
    def nothing(LM, TAU):
        TAU[:] = 0.0

    with pytest.raises(SceneError, match="'changing' = 1: the routine gives the stress itself"):
        usersub.StandardDriver(nothing, usersub.Scene(dimension=2, changing=1))
    # A coefficient that is negative is refused although what it is mixed with makes it positive.
    one = driver(FIRST, METHODS["penalty"])
    increment(one)
    negative = driver([-0.1, -0.1, 0.0, 0.0], METHODS["penalty"], changing=1)
    negative.state.load(one.state.save())
    negative.begin_increment(0.1, step=2, amplitude=0.01)
    with pytest.raises(ContractError, match="-0.1"):
        negative.iterate()
