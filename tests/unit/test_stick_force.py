# SPDX-License-Identifier: MIT
"""Stick forces of kinematic and penalty enforcement against exact arithmetic, both precisions."""

from __future__ import annotations

import ctypes
import math

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from usersub.statuses import STATUSES

CODE = {status.name: status.value for status in STATUSES}
PRECISIONS = {
    "double": (np.float64, ctypes.c_double, ""),
    "single": (np.float32, ctypes.c_float, "_single"),
}


class Helpers:
    """`kinematic(...)` and `penalty(...)` on numpy arrays: status and forces, which start as -7."""

    def __init__(self, library: ctypes.CDLL, precision: str):
        self.library = library
        self.dtype, self.real, self.suffix = PRECISIONS[precision]
        self.eps = float(np.finfo(self.dtype).eps)

    def call(self, name, vectors, scalars, *more):
        arrays = [np.ascontiguousarray(x, self.dtype) for x in (*vectors, scalars)]
        points, dimension = arrays[0].shape
        force = np.full(points, -7, self.dtype)
        pointers = [x.ctypes.data_as(ctypes.c_void_p) for x in arrays]
        status = getattr(self.library, f"usub_stick_force_{name}{self.suffix}")(
            points, dimension, *pointers, *map(self.real, more),
            force.ctypes.data_as(ctypes.c_void_p),
        )  # fmt: skip
        return status, force

    def kinematic(self, velocity, normal, mass, time_increment):
        return self.call("kinematic", (velocity, normal), mass, time_increment)

    def penalty(self, previous, slip, normal, stiffness):
        return self.call("penalty", (previous, slip, normal), stiffness)


@pytest.fixture(scope="session", params=list(PRECISIONS))
def helpers(request: pytest.FixtureRequest, enforcement: ctypes.CDLL) -> Helpers:
    return Helpers(enforcement, request.param)


def tangential(vector, normal):
    """Exact length of the part of a vector across a normal, and of the vector."""
    n = [mpmath.mpf(float(x)) for x in normal]
    along = mpmath.fsum(a * b for a, b in zip(vector, n, strict=True)) / sum(x * x for x in n)
    part = [a - along * b for a, b in zip(vector, n, strict=True)]
    return tuple(mpmath.sqrt(mpmath.fsum(x * x for x in v)) for v in (part, vector))


def exact(vector):
    return [mpmath.mpf(float(x)) for x in vector]


def units(vectors, dtype):
    vectors = np.asarray(vectors, float)
    return (vectors / np.linalg.norm(vectors, axis=1, keepdims=True)).astype(dtype)


component = st.floats(-1, 1).map(lambda x: x if abs(x) > 1e-6 else 0.0)


@st.composite
def cases(draw):
    """Vectors, normals and positive scalars of a few points in two or three dimensions."""
    dimension, points = draw(st.sampled_from([2, 3])), draw(st.integers(1, 5))
    rows = st.lists(st.tuples(*[component] * dimension), min_size=points, max_size=points)
    first, second, normal = draw(rows), draw(rows), draw(rows)
    assume(all(math.hypot(*n) > 0.1 for n in normal))
    scalars = draw(st.lists(st.floats(0, 9), min_size=points, max_size=points))
    return np.array(first), np.array(second), np.array(normal), np.array(scalars)


@given(case=cases(), time_increment=st.floats(1e-6, 10))
def test_kinematic(helpers, case, time_increment):
    velocity, _, normal, mass = case
    velocity, mass = velocity.astype(helpers.dtype), mass.astype(helpers.dtype)
    normal, dt = units(normal, helpers.dtype), helpers.dtype(time_increment)
    status, force = helpers.kinematic(velocity, normal, mass, dt)
    assert status == CODE["OK"]
    for i, value in enumerate(force):
        part, whole = tangential(exact(velocity[i]), normal[i])
        factor = mpmath.mpf(float(mass[i])) / mpmath.mpf(float(dt))
        # A projection rounds at eps |v|; one that small is dropped.
        allowed = factor * helpers.eps * (6 * whole + 3 * part)
        tiny = float(np.finfo(helpers.dtype).smallest_subnormal)
        assert abs(float(value) - factor * part) <= allowed + tiny


@given(case=cases(), scale=st.floats(1e-3, 1e6))
def test_penalty(helpers, case, scale):
    previous, slip, normal, stiffness = case
    previous, slip = previous.astype(helpers.dtype), slip.astype(helpers.dtype)
    normal, stiffness = units(normal, helpers.dtype), (scale * stiffness).astype(helpers.dtype)
    status, force = helpers.penalty(previous, slip, normal, stiffness)
    assert status == CODE["OK"]
    for i, value in enumerate(force):
        f, s, k = exact(previous[i]), exact(slip[i]), mpmath.mpf(float(stiffness[i]))
        part, _ = tangential([a - k * b for a, b in zip(f, s, strict=True)], normal[i])
        size = mpmath.sqrt(sum(x * x for x in f)) + k * mpmath.sqrt(sum(x * x for x in s))
        tiny = float(np.finfo(helpers.dtype).smallest_subnormal)
        assert abs(float(value) - part) <= 8 * helpers.eps * size + tiny


def test_by_hand(helpers):
    """A node of mass 3 at (4, -3, 2) over the plane z, and in two dimensions along x."""
    status, force = helpers.kinematic([[4, -3, 2], [1, 2, 2]], [[0, 0, 1], [1, 0, 0]], [3, 5], 0.5)
    assert status == CODE["OK"]
    np.testing.assert_allclose(force, [30, 5 * math.sqrt(8) / 0.5], rtol=4 * helpers.eps)
    status, force = helpers.kinematic([[4, -3], [1, 2]], [[0, 1], [1, 0]], [3, 5], 0.5)
    assert force.tolist() == [24, 20]
    # Previous force and slip at right angles; the normal parts do not count.
    status, force = helpers.penalty([[3, 0, 9]], [[0, 0.5, 7]], [[0, 0, 1]], [8])
    assert status == CODE["OK"] and force.tolist() == [5]
    # The spring has just reached the force that the slip takes back.
    status, force = helpers.penalty([[3, 9]], [[0.5, 7]], [[0, -1]], [6])
    assert status == CODE["OK"] and force.tolist() == [0]


def test_kinematic_force_stops_the_node(helpers):
    """After the increment the tangential velocity is zero and the normal one as before."""
    velocity = np.array([4.0, -3.0, 2.0])
    normal = units([[0.3, -0.2, 0.7]], helpers.dtype)
    mass, dt = 3.0, 0.01
    _, force = helpers.kinematic([velocity], normal, [mass], dt)
    n = normal[0].astype(float)
    slip = velocity - (velocity @ n) * n
    after = velocity - dt / mass * float(force[0]) * slip / np.linalg.norm(slip)
    assert np.linalg.norm(after - (velocity @ n) * n) <= 8 * helpers.eps * np.linalg.norm(velocity)


def test_products_do_not_overflow_on_the_way(helpers):
    large, small = (1e30, 1e-30) if helpers.suffix else (1e250, 1e-250)
    _, force = helpers.kinematic([[large, 0, 0]], [[0, 0, 1]], [large], large)
    assert force[0] == pytest.approx(large, rel=4 * helpers.eps)
    _, force = helpers.kinematic([[0, small, 0]], [[0, 0, 1]], [small], small)
    assert force[0] == pytest.approx(small, rel=4 * helpers.eps)
    _, force = helpers.penalty([[0, small, 0]], [[0, 0, 0]], [[0, 0, 1]], [large])
    assert force[0] == pytest.approx(small, rel=4 * helpers.eps)


GOOD_KINEMATIC = {
    "velocity": [[4.0, -3.0, 2.0], [1.0, 2.0, 2.0]],
    "normal": [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
    "mass": [3.0, 5.0],
    "time_increment": 0.5,
}
GOOD_PENALTY = {
    "previous": [[3.0, 0.0, 9.0], [1.0, 2.0, 2.0]],
    "slip": [[0.0, 0.5, 7.0], [1.0, 2.0, 2.0]],
    "normal": [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
    "stiffness": [8.0, 7.0],
}


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("velocity", [[4.0, -3.0, 2.0], [1.0, math.nan, 2.0]]),
        ("velocity", [[4.0, -3.0, 2.0], [1.0, math.inf, 2.0]]),
        ("normal", [[0.0, 0.0, 1.0], [math.nan, 0.0, 0.0]]),
        ("normal", [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]),
        ("normal", [[0.0, 0.0, 1.0], [1.1, 0.0, 0.0]]),
        ("mass", [3.0, -5.0]),
        ("mass", [3.0, math.nan]),
        ("mass", [3.0, math.inf]),
        ("time_increment", 0.0),
        ("time_increment", -0.5),
        ("time_increment", math.nan),
        ("time_increment", math.inf),
    ],
)
def test_kinematic_refuses(helpers, argument, value):
    status, force = helpers.kinematic(**GOOD_KINEMATIC | {argument: value})
    assert status == CODE["BAD_ARGUMENT"]
    assert (force == -7).all()


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("previous", [[3.0, math.nan, 9.0], [1.0, 2.0, 2.0]]),
        ("slip", [[0.0, 0.5, 7.0], [math.nan, 2.0, 2.0]]),
        ("normal", [[0.0, 0.0, 1.0], [1.0, math.nan, 0.0]]),
        ("normal", [[0.0, 0.0, 2.0], [1.0, 0.0, 0.0]]),
        ("stiffness", [8.0, math.nan]),
        ("stiffness", [-8.0, 7.0]),
    ],
)
def test_penalty_refuses(helpers, argument, value):
    status, force = helpers.penalty(**GOOD_PENALTY | {argument: value})
    assert status == CODE["BAD_ARGUMENT"]
    assert (force == -7).all()


def test_shape_and_pointers_are_checked(helpers):
    kinematic = getattr(helpers.library, f"usub_stick_force_kinematic{helpers.suffix}")
    penalty = getattr(helpers.library, f"usub_stick_force_penalty{helpers.suffix}")
    dt, some = helpers.real(0.5), np.ones(8, helpers.dtype).ctypes.data_as(ctypes.c_void_p)
    assert kinematic(0, 3, None, None, None, dt, None) == CODE["OK"]
    assert penalty(0, 2, None, None, None, None, None) == CODE["OK"]
    assert kinematic(-1, 3, some, some, some, dt, some) == CODE["BAD_ARGUMENT"]
    assert penalty(-1, 3, some, some, some, some, some) == CODE["BAD_ARGUMENT"]
    for dimension in (1, 4):
        assert kinematic(1, dimension, some, some, some, dt, some) == CODE["BAD_ARGUMENT"]
        assert penalty(1, dimension, some, some, some, some, some) == CODE["BAD_ARGUMENT"]
    for missing in range(3):
        arguments = [None if i == missing else some for i in range(3)]
        assert kinematic(1, 3, *arguments, dt, some) == CODE["BAD_ARGUMENT"]
    for missing in range(5):
        arguments = [None if i == missing else some for i in range(5)]
        assert penalty(1, 3, *arguments) == CODE["BAD_ARGUMENT"]
