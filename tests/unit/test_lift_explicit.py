# SPDX-License-Identifier: MIT
"""Law functions behind VFRIC, VFRICTION and VFRIC_COEF, bristle laws behind all that carry them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mpmath import mp, mpf, workdps

import usersub
from usersub.errors import RoutineError

N = 4
DT = 0.02
PROPS = [0.3, 0.05, 2.0, 1e-4]
SLIP = np.array([0.011, 0.023, 0.004, 0.05])
FORCE = np.array([110.0, 900.0, 0.0, 2400.0])
AREA = np.array([0.5, 1.25, 2.0, 0.75])
STICK = np.array([1e9, 1e9, 1e9, 60.0])
WARM = np.array([90.0, 160.0, 210.0, 40.0])
COLD = np.array([30.0, 70.0, 110.0, 20.0])
FIELD = np.array([[0.1, 0.2, 0.3, 0.4]])
OTHER = np.array([[0.9, 0.5, 0.1, 0.2]])


@usersub.coefficient(props=4, states=1)
def worn(slip_rate, pressure, temperature, fields, slip_increment, time_increment, state, props):
    state[0] = state[0] + slip_increment + 0.1 * time_increment
    mu = props[0] * math.exp(-slip_rate / props[2]) + props[1] * state[0]
    return mu + props[3] * pressure + 1e-4 * temperature + 0.01 * fields[0]


@usersub.strength(props=4, states=1)
def worn_strength(pressure, slip_increment, state, props):
    state[0] = state[0] + slip_increment
    return 100.0 * props[0] + props[1] * pressure + 50.0 * state[0]


@usersub.traction(props=4)
def viscous(slip_rate, temperature, props):
    return 40.0 * slip_rate + props[0] * temperature


def formula(law, slip, dt, force, area, temperature, field, state):
    """The laws once more for one point: force and state at the end."""
    rate, pressure = slip / dt, force / area
    if law is worn:
        new = state + slip + 0.1 * dt
        mu = PROPS[0] * math.exp(-rate / PROPS[2]) + PROPS[1] * new + PROPS[3] * pressure
        return (mu + 1e-4 * temperature + 0.01 * field) * force, new
    if law is worn_strength:
        new = state + slip
        return (100 * PROPS[0] + PROPS[1] * pressure + 50 * new) * area, new
    return (40 * rate + PROPS[0] * temperature) * area, 0.0


def driver_of(law, interface, precision="double", compiled=True):
    surface = {"secondary_nodes": N, "main_nodes": 4} if interface == "vfric" else {}
    scene = usersub.Scene(
        points=N, dimension=3, props=PROPS, temperatures=1, fields=1, precision=precision,
        states=law.states(interface), **surface,
    )  # fmt: skip
    return usersub.ExplicitDriver(law.behind(interface, precision, compiled=compiled), scene)


def arrays_of(driver, slip, normal=None, force=FORCE):
    """Everything that a driver may want, each point with its own numbers."""
    real = np.float32 if driver.scene["precision"] == "single" else np.float64
    up = np.tile([[0.0], [0.0], [1.0]], N) if normal is None else normal
    given = {
        "slip_increment": slip, "normal": up, "normal_force": force, "stick_force": STICK,
        "area": AREA, "temperature_secondary": WARM, "temperature_main": COLD,
        "field_secondary": FIELD, "field_main": OTHER, "pressure": FORCE / AREA,
    }  # fmt: skip
    ports = driver.layout.ports
    arrays = {k: np.array(a, dtype=real, order="F") for k, a in given.items() if k in ports}
    if driver.scene["secondary_nodes"]:
        arrays["secondary_node"] = np.array([3, 1, 4, 2], dtype=np.int32)
        if "area" in arrays:
            arrays["area"][arrays["secondary_node"] - 1] = AREA
    return arrays


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
@pytest.mark.parametrize("law", [worn, worn_strength, viscous], ids=lambda law: law.name)
def test_forces_and_states(law, interface, precision):
    driver = driver_of(law, interface, precision)
    state = [0.0] * N
    direction = np.array([[0.6], [-0.8], [0.0]])
    for times in (1.0, 2.0):
        found = driver.step(DT, **arrays_of(driver, direction * SLIP * times)).force
        for i in range(N):
            if not FORCE[i] > 0:
                assert not found[:, i].any()
                continue
            size, state[i] = formula(
                law, SLIP[i] * times, DT, FORCE[i], AREA[i], 0.5 * (WARM[i] + COLD[i]),
                0.5 * (FIELD[0, i] + OTHER[0, i]), state[i],
            )  # fmt: skip
            expected = -min(size, STICK[i]) * direction[:, 0]
            # Single precision: a few roundings of 6e-8.
            tolerance = 1e-13 if precision == "double" else 2e-6
            assert found[:, i] == pytest.approx(expected, rel=tolerance, abs=1e-30)


@pytest.mark.parametrize("interface", ["vfric", "vfriction", "vfric_coef"])
def test_the_interpreter_does_the_same(interface):
    @usersub.coefficient(props=1)
    def law(slip_rate, pressure, temperature, fields, slip_increment, time_increment, props):
        growth = slip_increment / (1.0 + time_increment) + fields[0]
        return props[0] * math.exp(-slip_rate) + 1e-4 * pressure * temperature + growth

    found = []
    for compiled in (True, False):
        driver = driver_of(law, interface, compiled=compiled)
        motion = np.array([[0.6], [-0.8], [0.0]]) * SLIP
        found.append(driver.step(DT, **arrays_of(driver, motion)).force)
    assert np.abs(found[0]).max() > 1.0
    np.testing.assert_array_equal(*found)


def test_coefficient_of_many_points():
    @usersub.coefficient(props=2)
    def law(slip_rate, pressure, temperature, fields, slip_increment, time_increment, props):
        return props[0] + slip_rate * props[1] + pressure + temperature * fields[1] + slip_increment

    scene = usersub.Scene(points=3, props=[0.5, 2.0], temperatures=1, fields=2)
    for precision in ("double", "single"):
        scene = usersub.Scene(
            points=3, props=[0.5, 2.0], temperatures=1, fields=2, precision=precision
        )
        driver = usersub.CoefficientDriver(law.behind("vfric_coef", precision), scene)
        real = np.float32 if precision == "single" else np.float64
        rates, pressures = np.array([1, 2, 3], real), np.array([10, 20, 30], real)
        mu = driver.evaluate(
            slip_rate=rates, pressure=pressures, temperature=np.array([5, 6, 7], real),
            field=np.asfortranarray([[1, 2, 3], [4, 5, 6]], dtype=real), time_increment=0.25,
        )  # fmt: skip
        expected = 0.5 + 2.0 * rates + pressures + np.array([20.0, 30.0, 42.0]) + 0.25 * rates
        np.testing.assert_allclose(mu, expected, rtol=1e-6 if precision == "single" else 1e-15)


@usersub.traction(vectors=2, states=1, props=4)
def bristles(motion, time_increment, pressure, temperature, fields, vectors, state, props):
    """Two springs with sliders that harden with the length of the path, and a damper."""
    state[0] = state[0] + math.hypot(motion[0], motion[1])
    first, second = 0.0, 0.0
    for i in range(2):
        x = vectors[i, 0] + motion[0]
        y = vectors[i, 1] + motion[1]
        bound = props[i] * (1.0 + 0.1 * pressure + 0.02 * temperature + fields[0] + state[0])
        share = 1.0 / max(1.0, math.hypot(x, y) / bound)
        vectors[i, 0] = share * x
        vectors[i, 1] = share * y
        first = first + props[2] * vectors[i, 0]
        second = second + props[2] * vectors[i, 1]
    return first + props[3] * motion[0] / time_increment, second + props[3] * motion[
        1
    ] / time_increment


BRISTLE_PROPS = [0.002, 0.005, 3000.0, 0.5]


def exact_bristles(motion, pressure, temperature, field, vectors, state, dt):
    """The law in mpmath."""
    q = [mpf(x) for x in BRISTLE_PROPS]
    length = mp.sqrt(sum(m * m for m in motion))
    new_state, tau, new = state + length, [mpf(0), mpf(0)], []
    for i in range(2):
        v = [vectors[i][a] + motion[a] for a in (0, 1)]
        bound = q[i] * (1 + mpf(0.1) * pressure + mpf(0.02) * temperature + field + new_state)
        share = 1 / max(mpf(1), mp.sqrt(v[0] ** 2 + v[1] ** 2) / bound)
        new.append([share * c for c in v])
        tau = [t + q[2] * c for t, c in zip(tau, new[-1], strict=True)]
    return [t + q[3] * m / dt for t, m in zip(tau, motion, strict=True)], new, new_state


@pytest.mark.parametrize("compiled", [True, False], ids=["machine", "interpreter"])
@pytest.mark.parametrize("n", [1, 2])
def test_bristles_behind_fric(n, compiled):
    law = bristles
    scene = usersub.Scene(
        points=1, dimension=n + 1, props=BRISTLE_PROPS, temperatures=1, temperature_tangent=1,
        fields=1, states=law.states("fric", n),
    )  # fmt: skip
    driver = usersub.StandardDriver(law.behind("fric", compiled=compiled), scene)

    def iterate(motion, pressure):
        return driver.iterate(
            slip_increment=np.array(motion).reshape(-1, 1), pressure=np.array([pressure]),
            temperature_secondary=WARM[:1], temperature_main=COLD[:1],
            field_secondary=FIELD[:, :1].copy(order="F"), field_main=OTHER[:, :1].copy(order="F"),
        )  # fmt: skip

    driver.begin_increment(1.0)
    iterate([0.0] * n, 3.0)
    driver.commit()
    field = (mpf(FIELD[0, 0]) + mpf(OTHER[0, 0])) / 2
    vectors, state = [[mpf(0)] * 2] * 2, mpf(0)
    for motion, pressure in (([0.004, -0.001], 7.0), ([0.09, 0.05], 2.0), ([-0.006, 0.0021], 3.0)):
        start = [mpf(x) for x in (*motion[:n], *([0.0] * (2 - n)), pressure, WARM[0], COLD[0])]

        def stress(x, vectors=vectors, state=state):
            return exact_bristles(x[:2], x[2], (x[3] + x[4]) / 2, field, vectors, state, mpf(DT))

        with workdps(50):
            tau, new, new_state = stress(start)
            slopes = np.empty((n, 5))
            for k in range(5):
                ends = []
                for sign in (1, -1):
                    moved = list(start)
                    moved[k] += sign * mpf(10) ** -22
                    ends.append(stress(moved)[0])
                difference = [(a - b) / (2 * mpf(10) ** -22) for a, b in zip(*ends, strict=True)]
                slopes[:, k] = [float(d) for d in difference[:n]]
        driver.begin_increment(DT)
        iterate([3.0 * m for m in motion[:n]], pressure)  # a trial leaves no trace
        found = iterate(motion[:n], pressure)
        driver.commit()
        assert found.tau[:, 0] == pytest.approx([float(t) for t in tau[:n]], rel=1e-12)
        keep = [*range(n), 2, 3, 4]
        whole = np.concatenate(
            [found.ddtddg[:, :, 0], found.ddtddp[:, :1], found.ddtddt[:, :, 0]], axis=1
        )
        np.testing.assert_allclose(whole, slopes[:, keep], rtol=1e-9, atol=1e-10)
        assert found.sfd[0] == pytest.approx(float(found.tau[:, 0] @ motion[:n]), rel=1e-13)
        vectors, state = new, new_state
    kept = driver.state["state"].reshape(-1)
    assert kept[-1] == pytest.approx(float(state), rel=1e-13)


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_bristles_are_kept_in_global_components(interface):
    # The slip turns in the plane between increments, so that the local directions do; the truth
    # works in fixed directions of the plane.
    random = np.random.default_rng(3)
    normal = random.normal(size=(3, N))
    normal /= np.linalg.norm(normal, axis=0)
    first = np.cross(normal.T, random.normal(size=(N, 3))).T
    first /= np.linalg.norm(first, axis=0)
    second = np.cross(normal.T, first.T).T
    surface = {"secondary_nodes": N, "main_nodes": 4} if interface == "vfric" else {}
    scene = usersub.Scene(
        points=N, dimension=3, props=BRISTLE_PROPS, temperatures=1, fields=1,
        states=bristles.states(interface), **surface,
    )  # fmt: skip
    assert bristles.states(interface) == 7
    driver = usersub.ExplicitDriver(bristles.behind(interface), scene)
    kept = [([[mpf(0)] * 2] * 2, mpf(0)) for _ in range(N)]
    force = np.array([11.0, 9.0, 0.0, 24.0])
    for angle in (0.3, 1.9, -2.5):
        motion = (math.cos(angle) * first + math.sin(angle) * second) * SLIP
        arrays = arrays_of(driver, motion, normal, force)
        found = driver.step(DT, **arrays).force
        for i in range(N):
            if not force[i] > 0:
                assert not found[:, i].any()
                continue
            local = [mpf(math.cos(angle) * SLIP[i]), mpf(math.sin(angle) * SLIP[i])]
            tau, *kept[i] = exact_bristles(
                local, mpf(force[i] / AREA[i]), mpf(0.5 * (WARM[i] + COLD[i])),
                mpf(0.5 * (FIELD[0, i] + OTHER[0, i])), *kept[i], mpf(DT),
            )  # fmt: skip
            plane = float(tau[0]) * first[:, i] + float(tau[1]) * second[:, i]
            size = np.abs(plane).max()
            assert found[:, i] == pytest.approx(-plane * AREA[i], rel=1e-12, abs=1e-13 * size)


@pytest.mark.parametrize("interface", ["vfric", "vfriction"])
def test_too_few_states_are_refused(interface):
    surface = {"secondary_nodes": N, "main_nodes": 4} if interface == "vfric" else {}
    for law, states in ((bristles, 6), (worn_strength, 0)):
        scene = usersub.Scene(
            points=N, dimension=3, props=PROPS, temperatures=1, fields=1, states=states, **surface
        )
        driver = usersub.ExplicitDriver(law.behind(interface), scene)
        motion = np.array([[0.6], [-0.8], [0.0]]) * SLIP
        with pytest.raises(RoutineError, match="has too few state variables|no state|states = 0"):
            driver.step(DT, **arrays_of(driver, motion))
