# SPDX-License-Identifier: MIT
"""Every argument of FRIC_COEF and VFRIC_COEF in a coefficient driver, and what comes back."""

from __future__ import annotations

import numpy as np
import pytest
from engine_probe import compare, padded

import usersub

POINTS = 9
PROPS = (0.25, -7.0, 3.5)
TIMES = (0.625, 3.375, 0.125)
KINDS = [
    ("vfric_coef", None, "double"),
    ("vfric_coef", None, "single"),
    ("fric_coef", "legacy", "double"),
    ("fric_coef", "2022", "double"),
]
HAVES = {"bare": {}, "temperatures": {"temperatures": 1}, "all": {"temperatures": 1, "fields": 3}}


def arrays(generation, precision, fields):
    random = np.random.default_rng(7)
    real = np.float64 if precision == "double" else np.float32
    made = {
        "pressure": random.uniform(1, 2, POINTS),
        "temperature": random.uniform(300, 400, POINTS),
        "field": random.uniform(5, 6, (fields, POINTS)),
    }
    if generation == "2022":
        made["slip_data"] = random.uniform(-1, 1, (6, POINTS))
    else:
        made["slip_rate"] = random.uniform(0, 1, POINTS)
    return {n: np.asfortranarray(a.astype(real)) for n, a in made.items() if a.size}


def scene(precision, haves, **more):
    return usersub.Scene(
        points=POINTS, precision=precision, props=PROPS, interaction="Int", secondary="Sec",
        main="Main", **haves, **more,
    )  # fmt: skip


def expected(host, generation, precision, haves, block, states=0):
    count = block.stop - block.start
    fields = haves.get("fields", 0)
    warm = haves.get("temperatures", 0)
    real = np.float64 if precision == "double" else np.float32
    common = {
        "nBlock": count, "nProps": 3, "nTemp": warm, "nFields": fields, "surfInt": padded("Int"),
        "surfSec": padded("Sec"), "surfMain": padded("Main"), "props": np.array(PROPS, real),
        "pressure": host["pressure"][block],
        "tempAvg": host["temperature"][block] if warm else np.zeros(count),
        "fieldAvg": host["field"][:, block].T if fields else np.zeros((count, 0)),
    }  # fmt: skip
    if generation != "2022":
        return common | {
            "fCoef": np.zeros(count), "fCoefDeriv": np.zeros((count, 3)),
            "jFlags": np.array([2, 5]), "rData": np.array(TIMES, real),
            "slipRate": host["slip_rate"][block],
        }  # fmt: skip
    coefficients = np.zeros((count, 2))
    coefficients[:, 1] = np.nan
    return common | {
        "fCoef": coefficients, "fCoefDeriv": np.zeros((count, 20, 2)),
        "iData": np.array([2, 5, 1, block.start + 1, states, 2]),
        "rData": np.array([*TIMES, 1, 0, 0, 1, *(10.0 + block.start + np.arange(states))]),
        "slipData": host["slip_data"][:, block].T,
    }  # fmt: skip


def evaluate(driver, host):
    cold = () if driver.scene["temperatures"] else ("temperature",)
    host = {name: array for name, array in host.items() if name not in cold}
    return driver.evaluate(
        time_increment=TIMES[2], step_time=TIMES[0], total_time=TIMES[1], step=2, increment=5,
        **host,
    )  # fmt: skip


@pytest.mark.parametrize("style", ["full", "block", "python"])
@pytest.mark.parametrize("haves", HAVES)
@pytest.mark.parametrize("block", [0, 1, 7, 9, 50])
@pytest.mark.parametrize(("interface", "generation", "precision"), KINDS)
def test_every_argument(probe, interface, generation, precision, block, haves, style):
    """A 2022 routine without a promise is called with one point, whatever the block."""
    host = arrays(generation, precision, HAVES[haves].get("fields", 0))
    made = probe(style, interface, generation=generation, precision=precision)
    driver = usersub.CoefficientDriver(made.routine, scene(precision, HAVES[haves], block=block))
    evaluate(driver, host)
    size = 1 if interface == "fric_coef" else block or POINTS
    blocks = [slice(k, min(k + size, POINTS)) for k in range(0, POINTS, size)]
    compare(
        made.checked_calls(),
        [expected(host, generation, precision, HAVES[haves], b) for b in blocks],
        0.0,
    )


@pytest.mark.parametrize("generation", ["legacy", "2022"])
def test_routines_that_promise_to_be_safe_get_blocks(probe, generation):
    host = arrays(generation, "double", 3)
    made = probe("full", "fric_coef", generation=generation, block_safe=True)
    driver = usersub.CoefficientDriver(made.routine, scene("double", HAVES["all"], block=7))
    evaluate(driver, host)
    blocks = [slice(0, 7), slice(7, 9)]
    compare(
        made.checked_calls(),
        [expected(host, generation, "double", HAVES["all"], b) for b in blocks],
        0.0,
    )


def answer(me, view):
    """Numbers that tell point, coefficient and derivative apart; state one higher."""
    call = me.calls[-1]
    number = call["iData"][3] if "iData" in call else 1
    coefficient, derivative = view("fCoef"), view("fCoefDeriv")
    points = np.arange(call["nBlock"]) + number
    modern = derivative.ndim == 3
    (coefficient[:, 0] if modern else coefficient)[:] = points
    for slot in range(3):
        (derivative[:, slot, 0] if modern else derivative[:, slot])[:] = 100 * (slot + 1) + points
    if "iData" in call and call["iData"][4]:
        view("rData")[7:] += 1


@pytest.mark.parametrize(("interface", "generation", "precision"), KINDS)
def test_what_comes_back(probe, interface, generation, precision):
    host = arrays(generation, precision, 0)
    made = probe("full", interface, generation=generation, precision=precision, act=answer)
    driver = usersub.CoefficientDriver(made.routine, scene(precision, {}, derivatives=1))
    result = evaluate(driver, host)
    made.checked_calls()
    one_by_one = interface == "fric_coef" and generation == "legacy"
    number = np.ones(POINTS) if one_by_one else np.arange(1.0, POINTS + 1)
    np.testing.assert_array_equal(result, number)
    wanted = number + 100.0 * np.arange(1, 4)[:, None]
    np.testing.assert_array_equal(driver.array("derivative"), wanted)


def test_state_of_the_2022_generation(probe):
    host = arrays("2022", "double", 0)
    made = probe("full", "fric_coef", generation="2022", act=answer, block_safe=True)
    driver = usersub.CoefficientDriver(made.routine, scene("double", {}, states=2, block=4))
    driver.state["state"][...] = 10.0 + np.arange(POINTS) + np.arange(2)[:, None]
    evaluate(driver, host)
    assert driver.plan.block == 1
    compare(
        made.checked_calls(),
        [expected(host, "2022", "double", {}, slice(k, k + 1), 2) for k in range(POINTS)],
        0.0,
    )
    wanted = 11.0 + np.arange(POINTS) + np.arange(2)[:, None]
    np.testing.assert_array_equal(driver.state["state"], wanted)


def test_two_coefficients(probe):
    def act(me, view):
        view("fCoef")[:] = [[0.25, 0.5]]

    host = arrays("2022", "double", 0)
    made = probe("full", "fric_coef", act=act)
    driver = usersub.CoefficientDriver(made.routine, scene("double", {}, anisotropic=1))
    assert list(evaluate(driver, host)) == [0.25] * POINTS
    assert list(driver.array("second_coefficient")) == [0.5] * POINTS


def test_slip_rate_alone_is_the_first_column_of_the_slip_data(probe):
    host = arrays("legacy", "double", 0)
    made = probe("full", "fric_coef", generation="2022")
    driver = usersub.CoefficientDriver(made.routine, scene("double", {}))
    evaluate(driver, host)
    for k, call in enumerate(made.checked_calls()):
        assert list(call["slipData"][0]) == [host["slip_rate"][k], 0, 0, 0, 0, 0]
