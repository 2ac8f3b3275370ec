# SPDX-License-Identifier: MIT
"""FRIC and FRIC_COEF of law functions: stress and tangents against mpmath, entry by entry.

The truth is the return mapping written once more in mpmath, with its own way of solving for the
slip, and differences of it in 60 digits.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpf, workdps

import usersub
from usersub.errors import RoutineError

LENGTH = 0.4
C = 0.005 * LENGTH
PROPS = [0.31, 0.12, 0.02, 3e-4, 1.5e-3, 40.0]


@usersub.coefficient(props=6, states=2)
def rich(slip_rate, pressure, temperature, fields, slip_increment, state, props):
    """Reads everything; state: slip so far, largest rate so far."""
    state[0] = state[0] + slip_increment
    state[1] = max(state[1], slip_rate)
    wear = 1.0 + 0.2 * math.exp(-props[5] * state[0])
    base = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slip_rate)
    base = base + props[4] * math.log(1.0 + state[1])
    return base * wear * (1.0 + props[3] * pressure) + 1e-4 * temperature + 0.01 * fields[0]


@usersub.strength(props=6, states=2)
def rich_strength(slip_rate, pressure, temperature, fields, slip_increment, state, props):
    state[0] = state[0] + slip_increment
    state[1] = max(state[1], slip_rate)
    wear = 1.0 + 0.2 * math.exp(-props[5] * state[0])
    base = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slip_rate)
    base = base + props[4] * math.log(1.0 + state[1])
    return 500.0 * base * wear * (1.0 + props[3] * pressure) + temperature + 3.0 * fields[0]


@usersub.coefficient(props=6, states=2)
def rich_pair(slip_rate, pressure, temperature, fields, slip_increment, state, props):
    state[0] = state[0] + slip_increment
    state[1] = max(state[1], slip_rate)
    wear = 1.0 + 0.2 * math.exp(-props[5] * state[0])
    base = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slip_rate)
    first = base * wear * (1.0 + props[3] * pressure) + 0.01 * fields[0]
    second = 0.4 * base + props[4] * math.log(1.0 + state[1]) + 1e-4 * temperature
    return first, second


@usersub.traction(props=6, states=2)
def rich_traction(slip_rate, pressure, temperature, fields, slip_increment, state, props):
    state[0] = state[0] + slip_increment
    state[1] = max(state[1], slip_rate)
    viscous = math.tanh(slip_rate / 3.0) * (1.0 + props[3] * pressure)
    return 90.0 * viscous + slip_rate * temperature * 0.01 + 5.0 * state[0] + fields[0] * slip_rate


def exact_values(kind, rate, p, temperature, field, slip, state):
    """The laws in mpmath: one or two values and the state at the end."""
    q = [mpf(x) for x in PROPS]
    new = (state[0] + slip, max(state[1], rate))
    if kind == "traction":
        viscous = mp.tanh(rate / 3) * (1 + q[3] * p)
        value = 90 * viscous + rate * temperature * mpf(0.01) + 5 * new[0] + field * rate
        return (value, value), new
    wear = 1 + mpf(0.2) * mp.exp(-q[5] * new[0])
    base = q[1] + (q[0] - q[1]) * mp.exp(-q[2] * rate)
    grown = q[4] * mp.log(1 + new[1])
    if kind == "pair":
        first = base * wear * (1 + q[3] * p) + mpf(0.01) * field
        return (first, mpf(0.4) * base + grown + mpf(1e-4) * temperature), new
    base += grown
    value = base * wear * (1 + q[3] * p)
    if kind == "strength":
        value = 500 * value + temperature + 3 * field
    else:
        value += mpf(1e-4) * temperature + mpf(0.01) * field
    return (value, value), new


def exact(kind, n, elastic, state, motion, p, temperatures, field, dt):
    """Stress of the return mapping, elastic slip and state at the end."""
    temperature = (temperatures[0] + temperatures[1]) / 2
    if kind == "traction":
        size = mp.sqrt(sum(m * m for m in motion))
        (value, _), new = exact_values(kind, size / dt, p, temperature, field, size, state)
        return [value * m / size for m in motion], [], new
    g = [e + m for e, m in zip(elastic, motion, strict=True)]

    def at(excess):
        share = excess / (mpf(C) + excess)
        slip = mp.sqrt(sum((share * x) ** 2 for x in g))
        values, new = exact_values(kind, slip / dt, p, temperature, field, slip, state)
        mean = (values[0] + values[1]) / 2
        scale = [v / mean for v in values] if n == 2 else [mpf(1)]
        mean = mean if n == 2 else values[0]
        size = mp.sqrt(sum((a * x) ** 2 for a, x in zip(scale, g, strict=True)))
        return size, scale, mean, new

    low, high = mpf(0), 2 * max(abs(x) for x in g)
    if at(low)[0] > C:  # bisection: the excess fits itself
        for _ in range(230):
            middle = (low + high) / 2
            low, high = (middle, high) if at(middle)[0] - C > middle else (low, middle)
    size, scale, mean, new = at(low)
    reach = size if low > 0 else mpf(C)
    limit = mean if kind == "strength" else mean * p
    tau = [limit * a * a * x / reach for a, x in zip(scale, g, strict=True)]
    return tau, [mpf(C) / (C + low) * x for x in g], new


LAWS = {"coefficient": rich, "strength": rich_strength, "pair": rich_pair,
        "traction": rich_traction}  # fmt: skip

#: Motions: into slip, turned slip, stick, the corner from both sides, back.
PATHS = {
    1: [[0.3 * C], [3.0 * C], [0.2], [-0.7 * C], [-1.5 * C], [1.9999 * C], [2e-4 * C]],
    2: [
        [0.2 * C, -0.3 * C], [2.5 * C, 1.0 * C], [0.09, 0.17], [-0.4 * C, -0.2 * C],
        [-0.3 * C, 0.1 * C], [-0.05, 0.02], [0.002 * C, -0.001 * C],
    ],
}  # fmt: skip
PRESSURES = [110.0, 270.0, 90.0, 140.0, 310.0, 205.0, 33.0]
WARM, COLD, FIELDS = 170.0, 91.0, (0.8, 0.5)
DT = 0.013


def driver_of(kind, interface, n, compiled=True):
    law = LAWS[kind]
    dimension = n + 1
    scene = usersub.Scene(
        points=1, dimension=dimension, props=PROPS, temperatures=1, fields=1,
        temperature_tangent=1, characteristic_length=LENGTH,
        anisotropic=int(kind == "pair" and interface == "fric_coef"),
        states=law.states(interface, n, dimension),
    )  # fmt: skip
    driver = usersub.StandardDriver(law.behind(interface, compiled=compiled), scene)
    if interface == "fric":  # the increment that closes the point
        driver.begin_increment(1.0)
        iterate(driver, [0.0] * n, 50.0)
        driver.commit()
    return driver


def iterate(driver, motion, pressure):
    return driver.iterate(
        slip_increment=np.array(motion, dtype=float).reshape(-1, 1),
        pressure=np.array([float(pressure)]),
        temperature_secondary=np.array([WARM]),
        temperature_main=np.array([COLD]),
        field_secondary=np.full((1, 1), FIELDS[0], order="F"),
        field_main=np.full((1, 1), FIELDS[1], order="F"),
    )


def follow(kind, interface, n, compiled=True):
    """Drives a path and compares every increment: stress, tangents, state."""
    driver = driver_of(kind, interface, n, compiled)
    elastic, state = [mpf(0)] * n, (mpf(0), mpf(0))
    field = (mpf(FIELDS[0]) + mpf(FIELDS[1])) / 2
    for motion, pressure in zip(PATHS[n], PRESSURES, strict=True):
        start = [mpf(x) for x in (*motion, pressure, WARM, COLD)]

        def stress(x, elastic=elastic, state=state):
            found = exact(kind, n, elastic, state, x[:n], x[n], x[n + 1 :], field, mpf(DT))
            return found if len(found[0]) == n else None

        driver.begin_increment(DT)
        iterate(driver, [2.0 * m for m in motion], 0.5 * pressure)  # a trial leaves no trace
        found = iterate(driver, motion, pressure)
        driver.commit()
        tau, end, new = stress(start)
        assert found.tau[:, 0] == pytest.approx([float(t) for t in tau], rel=1e-12)
        h = [mpf(10) ** -25 * max(abs(x), C) for x in start]
        slopes = np.empty((n, n + 3))
        for k in range(n + 3):
            ends = []
            for sign in (1, -1):
                moved = list(start)
                moved[k] += sign * h[k]
                ends.append(stress(moved)[0])
            slopes[:, k] = [float((a - b) / (2 * h[k])) for a, b in zip(*ends, strict=True)]
        whole = np.concatenate(
            [found.ddtddg[:, :, 0], found.ddtddp[:, :1], found.ddtddt[:, :, 0]], axis=1
        )
        # Entry by entry; an entry that cancels is judged by the size of its block.
        for block in (slice(0, n), slice(n, n + 1), slice(n + 1, n + 3)):
            size = np.abs(slopes[:, block]).max()
            np.testing.assert_allclose(
                whole[:, block], slopes[:, block], rtol=1e-9, atol=1e-11 * size
            )
        elastic, state = end, new
    kept = driver.state["state"].reshape(-1)[-2:]
    assert kept == pytest.approx([float(s) for s in state], rel=1e-12)


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("kind", LAWS)
def test_fric_and_its_tangents(kind, n):
    with workdps(60):
        follow(kind, "fric", n)


@pytest.mark.parametrize(("kind", "n"), [("coefficient", 1), ("coefficient", 2), ("pair", 2)])
def test_fric_coef_and_the_tangents_that_the_driver_makes_of_it(kind, n):
    with workdps(60):
        follow(kind, "fric_coef", n)


@pytest.mark.parametrize("kind", LAWS)
def test_the_interpreter_does_the_same(kind):
    with workdps(60):
        follow(kind, "fric", 2, compiled=False)


@pytest.mark.parametrize("kind", LAWS)
def test_interpreter_and_machine_code_agree(kind):
    found = []
    for compiled in (True, False):
        driver = driver_of(kind, "fric", 2, compiled)
        driver.begin_increment(DT)
        response = iterate(driver, [0.03, -0.01], 120.0)
        found.append([*response.tau.ravel(), *response.ddtddg.ravel(), *response.ddtddp.ravel()])
    assert found[0] == pytest.approx(found[1], rel=1e-13)


@pytest.mark.parametrize(("pressure", "by_pressure"), [(0.0, 0.15), (-1.0, 0.0)])
@pytest.mark.parametrize("kind", ["one", "two"])
def test_pressure_of_zero_has_the_derivative_from_above(kind, pressure, by_pressure):
    @usersub.coefficient(props=1)
    def one(props):
        return props[0]

    @usersub.coefficient(props=1)
    def two(props):
        return props[0], props[0]

    law = one if kind == "one" else two
    scene = usersub.Scene(
        points=1, dimension=2, props=[0.15], states=1, characteristic_length=LENGTH
    )
    driver = usersub.StandardDriver(law.fric, scene)
    closed = np.ones(1, dtype=np.int32)
    for _ in range(2):
        driver.begin_increment(DT)
        found = driver.iterate(
            slip_increment=np.array([[1.0]]), pressure=np.array([pressure]), closed=closed
        )
        driver.commit()
    assert found.tau[0, 0] == 0.0
    assert found.ddtddp[0, 0] == by_pressure


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"states": 3}, "keeps its elastic slip in one state variable a direction, and its own"),
        ({"characteristic_length": 0.0}, "needs a characteristic length above zero"),
        ({"props": [0.1]}, "has too few properties"),
    ],
)
def test_scenes_that_do_not_fit_are_refused(changes, told):
    settings = {
        "points": 1, "dimension": 3, "props": PROPS, "temperatures": 1, "fields": 1,
        "characteristic_length": LENGTH, "states": 4,
    }  # fmt: skip
    driver = usersub.StandardDriver(rich.fric, usersub.Scene(**{**settings, **changes}))
    driver.begin_increment(1.0)
    iterate(driver, [0.0, 0.0], 50.0)
    driver.commit()
    driver.begin_increment(DT)
    with pytest.raises(RoutineError, match=told):
        iterate(driver, [0.1, 0.0], 50.0)


def test_the_line_of_the_law_is_told(tmp_path):
    file = tmp_path / "law.py"
    file.write_text(
        "import usersub\n\n\n@usersub.coefficient(props=1)\ndef mu(pressure, props):\n"
        "    if pressure > 5.0:\n        raise ValueError('too much')\n    return props[0]\n"
    )
    driver = usersub.CoefficientDriver(
        usersub.load(file)["vfric_coef"], usersub.Scene(points=2, props=[0.1])
    )
    with pytest.raises(RoutineError, match=r"too much.*law\.py:7"):
        driver.evaluate(slip_rate=np.ones(2), pressure=np.array([1.0, 9.0]))
