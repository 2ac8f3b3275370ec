# SPDX-License-Identifier: MIT
"""Local axes against exact arithmetic: orthonormal for any normal and any size of slip."""

from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st


@dataclass(frozen=True)
class Axes:
    """The axes of one precision: `axes(2 or 3, slip, n)` gives t1, t2, length."""

    library: ctypes.CDLL
    dtype: type
    suffix: str

    @property
    def eps(self) -> float:
        return float(np.finfo(self.dtype).eps)

    @property
    def real(self):
        return ctypes.c_double if self.suffix == "d" else ctypes.c_float

    def function(self, name: str):
        function = getattr(self.library, f"{name}_{self.suffix}")
        function.restype = self.real
        return function

    def axes(self, dimension: int, slip, n):
        slip, n = (np.ascontiguousarray(x, self.dtype) for x in (slip, n))
        t1, t2 = np.zeros((2, dimension), self.dtype)
        pointer = ctypes.POINTER(self.real)
        length = self.function(f"axes{dimension}")(
            *(x.ctypes.data_as(pointer) for x in (slip, n, t1, t2))
        )
        return t1, t2, length


@pytest.fixture(scope="session", params=["double", "single"])
def real(request: pytest.FixtureRequest, enforcement: ctypes.CDLL) -> Axes:
    single = request.param == "single"
    return Axes(enforcement, np.float32 if single else np.float64, "f" if single else "d")


def exact(vector) -> mpmath.matrix:
    return mpmath.matrix([mpmath.mpf(float(x)) for x in vector])


def dot(a, b):
    return mpmath.fsum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [
        a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    ]  # fmt: skip


def rounded_unit(vector, dtype) -> np.ndarray:
    """The vector over its length, rounded once: unit to half an ulp in each component."""
    v = exact(vector)
    length = mpmath.sqrt(dot(v, v))
    return np.array([float(x / length) for x in v]).astype(dtype)


def projected(slip, n):
    s, m = exact(slip), exact(n)
    along = dot(s, m) / dot(m, m)
    return [s[i] - along * m[i] for i in range(len(s))]


component = st.floats(-1, 1)
normals = st.one_of(
    st.tuples(component, component, component),
    # Close to the one point where the axis of zero slip cannot be continuous, and to its opposite.
    st.builds(
        lambda x, y, e, z: (x * 10.0**-e, y * 10.0**-e, z),
        component, component, st.integers(1, 200), st.sampled_from([-1.0, 1.0]),
    ),
    st.permutations([1.0, 0.0, 0.0]).map(tuple),
    st.permutations([-1.0, 0.0, -0.0]).map(tuple),
)  # fmt: skip


def check_orthonormal(real: Axes, n, t1, t2):
    """n is unit to an ulp, so a few ulp are what is left: measured at most 4 eps."""
    n, t1, t2 = exact(n), exact(t1), exact(t2)
    for a, b, value in [(t1, t1, 1), (t2, t2, 1), (t1, t2, 0), (t1, n, 0), (t2, n, 0)]:
        assert abs(dot(a, b) - value) <= 6 * real.eps
    handed = cross(n, t1)
    assert max(abs(handed[i] - t2[i]) for i in range(3)) <= 2 * real.eps


@given(
    normal=normals,
    slip=st.tuples(component, component, component),
    exponent=st.integers(-1074, 996),
    data=st.data(),
)
def test_orthonormal_and_along_the_slip(real, normal, slip, exponent, data):
    if real.suffix == "f":
        exponent = max(-149, min(exponent, 122))
    assume(math.hypot(*normal) > 1e-3 and max(map(abs, slip)) > 1e-3)
    n = rounded_unit(normal, real.dtype)
    along = data.draw(st.sampled_from([0.0, 1e-12, 1e-6, 1.0]), "share of the slip across n")
    slip = np.array(slip) if along == 1.0 else n + along * np.array(slip)
    with np.errstate(under="ignore"):
        slip = np.ldexp(slip.astype(real.dtype), exponent).astype(real.dtype)
    t1, t2, length = real.axes(3, slip, n)
    check_orthonormal(real, n, t1, t2)
    v = projected(slip, n)
    part = mpmath.sqrt(dot(v, v))
    whole = mpmath.sqrt(dot(exact(slip), exact(slip)))
    tiny = float(np.finfo(real.dtype).smallest_subnormal)
    # The projection rounds at eps |slip|; a direction can be no better than that over its length.
    # A part of 4 eps |slip| as it is computed is dropped.
    assert abs(length - part) <= (6 if length == 0 else 3) * real.eps * whole + tiny
    if part > 16 * real.eps * whole:
        allowed = 3 * real.eps * (1 + 3 * whole / part)
        assert max(abs(v[i] / part - float(t1[i])) for i in range(3)) <= allowed
    if part < real.eps * whole:
        assert length == 0 or length <= 6 * real.eps * whole + tiny


@given(angle=st.floats(-math.pi, math.pi), slip=st.tuples(component, component),
       exponent=st.integers(-1074, 996))  # fmt: skip
def test_two_dimensions(real, angle, slip, exponent):
    if real.suffix == "f":
        exponent = max(-149, min(exponent, 122))
    n = rounded_unit((math.cos(angle), math.sin(angle)), real.dtype)
    with np.errstate(under="ignore"):
        slip = np.ldexp(np.array(slip, real.dtype), exponent).astype(real.dtype)
    t1, _, length = real.axes(2, slip, n)
    forward = (t1 == [n[1], -n[0]]).all()
    assert forward or (t1 == [-n[1], n[0]]).all()
    s, m = exact(slip), exact(n)
    value = s[0] * m[1] - s[1] * m[0]
    whole = mpmath.sqrt(dot(s, s))
    tiny = float(np.finfo(real.dtype).smallest_subnormal)
    assert abs(length - abs(value)) <= 4 * real.eps * whole + tiny
    if abs(value) > 8 * real.eps * whole:
        assert forward == (value > 0)
        assert length > 0 or abs(value) < tiny
    if length == 0 and value == 0:
        assert forward


def zero_slip_axis(n):
    """Exact image of the x axis under the shortest rotation of z into n."""
    n = exact(n)
    n /= mpmath.sqrt(dot(n, n))
    radius2 = n[0] ** 2 + n[1] ** 2
    factor = 1 / (1 + n[2]) if n[2] >= 0 else (1 - n[2]) / radius2
    return [1 - factor * n[0] ** 2, -factor * n[0] * n[1], -n[0]]


@given(normal=normals)
def test_axis_of_zero_slip(real, normal):
    assume(math.hypot(*normal) > 1e-3)
    n = rounded_unit(normal, real.dtype)
    zero = np.zeros(3)
    t1, t2, length = real.axes(3, zero, n)
    assert length == 0
    check_orthonormal(real, n, t1, t2)
    assert (real.axes(3, -zero, n)[0] == t1).all()
    if n[0] != 0 or n[1] != 0 or n[2] > 0:
        expected = zero_slip_axis(n)
        # A denormal component of n has few digits, so the angle around z has few.
        smallest = max(abs(float(n[0])), abs(float(n[1])))
        if smallest > np.finfo(real.dtype).tiny or n[2] > 0:
            assert max(abs(expected[i] - float(t1[i])) for i in range(3)) <= 8 * real.eps


@given(normal=normals, turn=st.tuples(component, component, component),
       exponent=st.integers(1, 14))  # fmt: skip
def test_axis_of_zero_slip_is_continuous(real, normal, turn, exponent):
    """Lipschitz in n, with a constant that grows as one over the distance from (0, 0, -1)."""
    assume(math.hypot(*normal) > 1e-3)
    n = rounded_unit(normal, real.dtype)
    other = rounded_unit(n + np.array(turn) * 10.0**-exponent, real.dtype)
    step = math.hypot(*(n.astype(float) - other))
    distance = min(math.hypot(x[0], x[1]) if x[2] < 0 else 1.0 for x in (n, other))
    first, second = (real.axes(3, np.zeros(3), x)[0].astype(float) for x in (n, other))
    if step < 0.1 * distance:
        assert np.linalg.norm(first - second) <= 8 * step / distance + 16 * real.eps


def test_the_pole_has_a_fixed_axis(real):
    t1, t2, _ = real.axes(3, [0, 0, 0], [0, 0, -1])
    assert t1.tolist() == [1, 0, 0] and t2.tolist() == [0, -1, 0]
    t1, t2, _ = real.axes(3, [0, 0, 0], [0, 0, 1])
    assert t1.tolist() == [1, 0, 0] and t2.tolist() == [0, 1, 0]
    t1, _, _ = real.axes(2, [0, 0], [0.6, 0.8])
    assert t1.tolist() == [real.dtype(0.8), real.dtype(-0.6)]


def test_slip_along_the_normal_is_no_slip(real):
    n = rounded_unit((0.3, -0.7, 0.2), real.dtype)
    for size in (1.0, 7.3, -2.1):
        t1, _, length = real.axes(3, real.dtype(size) * n, n)
        assert length == 0
        assert (t1 == real.axes(3, [0, 0, 0], n)[0]).all()
    t1, _, length = real.axes(2, 3 * n[:2] / np.hypot(*n[:2]), n[:2] / np.hypot(*n[:2]))
    assert length == 0


def test_nan_stays_visible(real):
    t1, _, length = real.axes(3, [math.nan, 1, 2], [0, 0, 1])
    assert math.isnan(length) and np.isnan(t1).all()
    _, _, length = real.axes(2, [1, math.nan], [0, 1])
    assert math.isnan(length)


@given(x=st.floats(allow_nan=False, allow_infinity=False),
       y=st.floats(allow_nan=False, allow_infinity=False),
       z=st.floats(allow_nan=False, allow_infinity=False))  # fmt: skip
def test_norms(real, x, y, z):
    limit = 1e37 if real.suffix == "f" else 1e307
    x, y, z = (float(real.dtype(math.copysign(min(abs(v), limit), v))) for v in (x, y, z))
    tiny = float(np.finfo(real.dtype).smallest_subnormal)
    for name, arguments in (("norm2", (x, y)), ("norm3", (x, y, z))):
        value = real.function(name)(*map(real.real, arguments))
        expected = mpmath.sqrt(mpmath.fsum(mpmath.mpf(v) ** 2 for v in arguments))
        assert abs(value - expected) <= 2 * real.eps * expected + tiny


@given(st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 3))
def test_product_quotient(enforcement, numbers):
    a, b, c = numbers
    assume(c != 0)
    function = enforcement.product_quotient
    function.restype = ctypes.c_double
    value = function(*map(ctypes.c_double, numbers))
    expected = mpmath.mpf(a) * mpmath.mpf(b) / mpmath.mpf(c)
    if abs(expected) > mpmath.mpf(2) ** 1024:
        assert abs(value) == math.inf
    else:
        tiny = 5e-324
        assert abs(value - expected) <= 2.3e-16 * 2 * abs(expected) + tiny
