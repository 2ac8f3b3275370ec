# SPDX-License-Identifier: MIT
"""Cut-backs, failed and repeated iterations, saved states: bit for bit as if they never were."""

from __future__ import annotations

import math

import numpy as np
import pytest

import usersub
from usersub.errors import Error

POINTS = 4
METHODS = {
    "penalty": {"elastic_slip": 0.03},
    "softened": {"stick_slope": 40.0},
    "damped": {"elastic_slip": 0.03, "damping": 0.7},
    "lagrange": {"enforcement": "lagrange", "characteristic_length": 2.0, "damping": 0.2},
    "anisotropic": {"elastic_slip": 0.03, "anisotropic": 1, "shear_limit": 1.4},
    "lagrange anisotropic": {"enforcement": "lagrange", "anisotropic": 1, "shear_limit": 1.4},
    "changing": {"elastic_slip": 0.03, "changing": 1},
    "lagrange changing": {"enforcement": "lagrange", "changing": 1},
}
OUTPUTS = ("tau", "ddtddg", "ddtddp", "lm", "dslip", "sed", "sfd")


@usersub.fric_coef
def law(fCoef, fCoefDeriv, rData, slipData, pressure, props):
    """Rate-dependent, with a state variable that sums the time and hardens a little."""
    rData[7] += rData[2] * (1.0 + slipData[0, 0])
    weight = math.exp(-2.0 * slipData[0, 0])
    base = 0.25 + 0.2 * weight + 0.01 * rData[7]
    for k in range(2 if props[0] > 0.0 else 1):
        fCoef[0, k] = base * (1.0 + 0.4 * k)
        fCoefDeriv[0, 0, k] = -0.4 * weight * (1.0 + 0.4 * k)


class Path:
    """A driver that is led along a path of increments with random slips, pressures, multipliers."""

    def __init__(self, method):
        self.method = method
        scene = usersub.Scene(
            points=POINTS, dimension=3, states=1, props=[float(method.get("anisotropic", 0))],
            **method,
        )  # fmt: skip
        self.driver = usersub.StandardDriver(law, scene)
        self.slip = np.zeros((2, POINTS), order="F")
        self.multiplier, self.pressure = np.zeros((2, POINTS), order="F"), np.zeros(POINTS)
        self.driver.bind(
            slip_increment=self.slip, multiplier=self.multiplier, pressure=self.pressure
        )

    def begin(self, number, seed=0):
        step = 1 + number // 3
        amplitude = {"amplitude": 0.3 + 0.2 * (number % 3)} if "changing" in self.method else {}
        self.driver.begin_increment(0.1 + 0.01 * seed, step=step, **amplitude)

    def iterate(self, number, iteration, seed=0):
        generator = np.random.default_rng([number, iteration, seed])
        self.slip[...] = generator.normal(size=(2, POINTS)) * 0.05
        self.multiplier[...] = generator.normal(size=(2, POINTS))
        self.pressure[...] = generator.uniform(-0.5, 5.0, POINTS)
        found = self.driver.iterate()
        return [getattr(found, name).tobytes() for name in OUTPUTS]


def straight(method):
    """What every iteration and every commit of the path gives."""
    path, seen = Path(method), []
    for number in range(8):
        path.begin(number)
        answers = [path.iterate(number, k) for k in range(3)]
        path.driver.commit()
        seen.append((answers, path.driver.state.save()))
    return seen


@pytest.fixture(params=METHODS.values(), ids=METHODS.keys())
def method(request):
    return request.param


def test_cut_back(method):
    expected, path = straight(method), Path(method)
    for number in range(8):
        for attempt in range(1, 3):
            path.begin(number, attempt)
            for k in range(attempt):
                path.iterate(number, k, seed=attempt)
            path.driver.cut_back()
        path.begin(number)
        assert [path.iterate(number, k) for k in range(3)] == expected[number][0]
        path.driver.commit()
        assert path.driver.state.save() == expected[number][1]


def test_failed_iterations(method):
    """An iteration that is refused half-way through the points leaves nothing behind."""
    expected, path = straight(method), Path(method)
    for number in range(8):
        path.begin(number)
        answers = []
        for k in range(3):
            path.pressure[...] = 3.0
            path.pressure[POINTS - 1] = np.nan
            with pytest.raises(Error, match="pressure"):
                path.driver.iterate()
            answers.append(path.iterate(number, k))
        assert answers == expected[number][0]
        path.driver.commit()
        assert path.driver.state.save() == expected[number][1]


def test_repeated_iterations(method):
    """Asking again gives the same; with multipliers only LM remembers the last iteration, and
    what a point does is the same if it is in the same state."""
    path = Path(method)
    for number in range(6):
        path.begin(number)
        for k in range(2):
            first = path.iterate(number, k)
            again = path.iterate(number, k)
            if "lagrange" not in method.values():
                assert again == first
            lm = OUTPUTS.index("lm")
            if again[lm] == first[lm]:
                third = path.iterate(number, k)
                assert third[lm] == again[lm] and third[0] == again[0]
        path.driver.commit()


def test_save_and_load(method):
    expected, path = straight(method), Path(method)
    for number in range(8):
        fresh = Path(method)
        fresh.driver.state.load(path.driver.state.save())
        path = fresh
        path.begin(number)
        assert [path.iterate(number, k) for k in range(3)] == expected[number][0]
        path.driver.commit()
        assert path.driver.state.save() == expected[number][1]


def test_state_goes_from_method_to_method():
    """The next step of a host may enforce in another way: every state fits every method."""
    saved = straight(METHODS["changing"])[-1][1]
    for method in METHODS.values():
        path = Path(method)
        path.driver.state.load(saved)
        assert path.driver.state.save() == saved


def test_saving_says_why_it_fails():
    """Through the C interface: a buffer that is too small, or none."""
    from usersub.core import ffi, lib, text

    driver = Path(METHODS["penalty"]).driver
    handle, size = driver._handle, lib.usub_state_size(driver._handle)
    buffer = ffi.new("char[]", size)
    for data, room in ((buffer, size - 1), (ffi.NULL, size)):
        assert lib.usub_state_save(handle, data, room) < 0
        message = text(lib.usub_message(handle))
        assert f"takes {size} bytes; there are {room}" in message
    assert lib.usub_state_save(handle, buffer, size) == 0
    assert text(lib.usub_message(handle)) == ""


def test_open_points_have_no_committed_pressure():
    path = Path(METHODS["penalty"])
    path.driver.begin_increment(0.1)
    closed = np.array([1, 0, 1, 0], np.int32)
    path.pressure[...] = [3.0, 4.0, -2.0, 0.0]
    path.driver.iterate(closed=closed)
    path.driver.commit()
    assert path.driver.state["committed_pressure"].tolist() == [3.0, 0.0, -2.0, 0.0]
