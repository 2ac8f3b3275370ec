# SPDX-License-Identifier: MIT
"""The coefficient driver: values, views, binding, prepared calls, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import SceneError

POINTS = 7
PROPS = (0.3, 0.1, 0.02)

DECAY = """\
#include <math.h>
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = props[1] + (props[0] - props[1]) * exp(-props[2] * slipRate[k]) + 1e-3 * pressure[k];
}
"""


def decay(rate, pressure):
    """Closed form of DECAY."""
    return PROPS[1] + (PROPS[0] - PROPS[1]) * np.exp(-PROPS[2] * rate) + 1e-3 * pressure


def inputs(points: int = POINTS, dtype=np.float64) -> dict[str, np.ndarray]:
    return {
        "slip_rate": np.linspace(0.5, 90.0, points).astype(dtype),
        "pressure": np.linspace(3.0, 11.0, points).astype(dtype),
    }


def driver(c_routine, points: int = POINTS, **settings) -> usersub.CoefficientDriver:
    scene = usersub.Scene(points=points, props=PROPS, **settings)
    return usersub.CoefficientDriver(c_routine("vfric_coef", DECAY), scene)


def test_closed_form(c_routine):
    arrays = inputs()
    found = driver(c_routine).evaluate(**arrays)
    # one rounding each of exp, two products and two sums
    expected = decay(arrays["slip_rate"], arrays["pressure"])
    np.testing.assert_allclose(found, expected, rtol=4e-16)


def test_single_precision(c_routine):
    arrays = inputs(dtype=np.float32)
    routine = c_routine("vfric_coef", "#define USUB_SINGLE\n" + DECAY, precision="single")
    scene = usersub.Scene(points=POINTS, props=PROPS, precision="single")
    found = usersub.CoefficientDriver(routine, scene).evaluate(**arrays)
    assert found.dtype == np.float32
    expected = decay(arrays["slip_rate"].astype(float), arrays["pressure"].astype(float))
    np.testing.assert_allclose(found, expected, rtol=2e-7)


def test_results_are_copies_unless_reused(c_routine):
    fresh = driver(c_routine)
    first = fresh.evaluate(**inputs())
    second = fresh.evaluate(slip_rate=np.zeros(POINTS))
    assert not np.array_equal(first, second)

    routine, scene = fresh.routine, fresh.scene
    reusing = usersub.CoefficientDriver(routine, scene, reuse=True)
    first = reusing.evaluate(**inputs())
    second = reusing.evaluate(slip_rate=np.zeros(POINTS))
    assert second is first or np.shares_memory(first, second)


def test_bound_output_receives_results(c_routine):
    mine = np.full(POINTS, -1.0)
    made = driver(c_routine)
    made.evaluate(coefficient=mine, **inputs())
    np.testing.assert_array_equal(mine, made.array("coefficient"))
    assert made.array("coefficient") is mine
    made.bind(coefficient=None)
    assert not np.shares_memory(made.array("coefficient"), mine)


def test_view_keeps_the_driver_alive(c_routine):
    view = driver(c_routine).array("coefficient")
    view[:] = 3.0  # the driver itself is gone
    assert view.sum() == 3.0 * POINTS


def test_prepared_call_repeats(c_routine):
    made = driver(c_routine)
    rate = np.zeros(POINTS)
    pressure = inputs()["pressure"]
    made.bind(slip_rate=rate, pressure=pressure)
    call = made.prepare()
    for value in (0.0, 5.0, 80.0):
        rate[:] = value
        assert call() == 0
        np.testing.assert_allclose(made.array("coefficient"), decay(rate, pressure), rtol=4e-16)
    rate[3] = math.nan
    with pytest.raises(SceneError, match="slip_rate"):
        call()


@pytest.mark.parametrize("block", [1, 3, 7, 64])
@pytest.mark.parametrize("threads", [1, 3])
def test_blocks_and_threads_give_the_same_bits(c_routine, block, threads):
    points, arrays = 150, inputs(150)
    expected = driver(c_routine, points).evaluate(**arrays)
    routine = c_routine("vfric_coef", DECAY, thread_safe=True)
    scene = usersub.Scene(points=points, props=PROPS, block=block, threads=threads)
    made = usersub.CoefficientDriver(routine, scene)
    assert made.evaluate(**arrays).tobytes() == expected.tobytes()
    assert (made.plan.block, made.plan.threads) == (block, threads)


def test_fewer_points(c_routine):
    made = driver(c_routine)
    made.evaluate(**inputs())
    made.points = 3
    rate = np.zeros(POINTS)
    found = made.evaluate(slip_rate=rate)
    assert made.points == 3
    np.testing.assert_allclose(found[:3], decay(0.0, inputs()["pressure"][:3]), rtol=4e-16)
    with pytest.raises(SceneError, match="-1 points; expected 0 to 7"):
        made.points = -1
    with pytest.raises(SceneError, match="8 points"):
        made.points = 8
    with pytest.raises(SceneError, match="points = 2.5"):
        made.points = 2.5


@pytest.mark.parametrize("name", ["slip_rate", "pressure"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_values_that_are_not_finite(c_routine, name, value):
    arrays = inputs()
    arrays[name][4] = value
    made = driver(c_routine)
    with pytest.raises(SceneError, match=f"{name} of point 4") as caught:
        made.evaluate(**arrays)
    assert caught.value.status == -3


def test_missing_array():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef, slipRate):
        fCoef[:] = slipRate

    made = usersub.CoefficientDriver(law, usersub.Scene(points=POINTS))
    with pytest.raises(SceneError, match="'slip_rate' is not bound"):
        made.evaluate(pressure=inputs()["pressure"])


def test_refused_binding_changes_nothing(c_routine):
    made = driver(c_routine)
    made.evaluate(**inputs())
    with pytest.raises(SceneError, match="'pressure' has shape"):
        made.bind(slip_rate=np.zeros(POINTS), pressure=np.zeros(POINTS + 1))
    np.testing.assert_array_equal(made.array("slip_rate"), inputs()["slip_rate"])


def test_what_is_not_a_routine_or_scene(c_routine):
    routine = c_routine("vfric_coef", DECAY)
    with pytest.raises(SceneError, match="function as its routine"):
        usersub.CoefficientDriver(lambda fCoef: None, usersub.Scene())
    with pytest.raises(SceneError, match="dict as its scene"):
        usersub.CoefficientDriver(routine, {"points": 3})
    with pytest.raises(SceneError, match="StandardDriver has no interface VFRIC_COEF"):
        usersub.StandardDriver(routine, usersub.Scene())


def test_plan(c_routine):
    plan = driver(c_routine).plan
    assert [row.argument for row in plan.rows][:3] == ["fCoef", "fCoefDeriv", "nBlock"]
    assert all(row.used is None for row in plan.rows)  # nobody has said what the C code uses
    text = plan.explain()
    assert "fCoefDeriv" in text
    assert f"{plan.bytes} passed, {plan.bytes_full} if everything were passed" in text


def test_plan_leaves_out_what_is_not_used():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef, slipRate):
        fCoef[:] = 0.5 + slipRate

    scene = usersub.Scene(points=POINTS, temperatures=1, fields=2)
    made = usersub.CoefficientDriver(law, scene)
    arrays = inputs()
    np.testing.assert_allclose(made.evaluate(**arrays), 0.5 + arrays["slip_rate"], rtol=1e-16)
    plan = made.plan
    left_out = {row.argument for row in plan.rows if row.what == "left out"}
    assert {"pressure", "tempAvg", "fieldAvg", "fCoefDeriv"} <= left_out
    # the coefficient and the slip rate against also pressure, temperature, two fields, derivatives
    assert (plan.bytes, plan.bytes_full) == (16, 16 + 8 + 8 + 16 + 24)

    everything = usersub.CoefficientDriver(law, scene.replace(pass_everything=1))
    everything.bind(temperature=np.zeros(POINTS), field=np.zeros((2, POINTS), order="F"), **arrays)
    everything.evaluate()
    assert everything.plan.bytes == everything.plan.bytes_full == plan.bytes_full


def test_derivatives():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef, fCoefDeriv, slipRate, pressure, tempAvg):
        fCoef[:] = slipRate + 2.0 * pressure + 3.0 * tempAvg
        fCoefDeriv[:, 0], fCoefDeriv[:, 1], fCoefDeriv[:, 2] = 1.0, 2.0, 3.0

    scene = usersub.Scene(points=POINTS, temperatures=1, derivatives=1, block=3)
    made = usersub.CoefficientDriver(law, scene)
    made.evaluate(temperature=np.ones(POINTS), **inputs())
    np.testing.assert_array_equal(made.array("derivative"), np.tile([[1.0], [2.0], [3.0]], POINTS))
    with pytest.raises(SceneError, match="'second_coefficient' is not bound"):
        made.array("second_coefficient")


def test_clock_reaches_the_routine():
    seen = []

    @usersub.vfric_coef(compiled=False)
    def law(fCoef, jFlags, rData):
        seen.append((*map(int, jFlags), *map(float, rData)))

    made = usersub.CoefficientDriver(law, usersub.Scene(points=1))
    arrays = {"slip_rate": np.zeros(1), "pressure": np.ones(1)}
    made.evaluate(time_increment=0.5, **arrays)
    made.evaluate(time_increment=0.25)
    made.evaluate(time_increment=0.125, step=2)
    made.evaluate(time_increment=0.125, step_time=7.0, total_time=9.0, step=2, increment=5)
    assert seen == [
        (1, 1, 0.5, 0.5, 0.5),
        (1, 2, 0.75, 0.75, 0.25),
        (2, 1, 0.125, 0.875, 0.125),
        (2, 5, 7.0, 9.0, 0.125),
    ]
