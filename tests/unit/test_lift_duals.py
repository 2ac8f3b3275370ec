# SPDX-License-Identifier: MIT
"""Dual numbers: the value has the bits of the plain call, the derivatives those of the truth."""

from __future__ import annotations

import math
import struct

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

import usersub
from usersub.errors import CompileError, ContractError
from usersub.lift import rules

#: Positive numbers on which every function below is smooth and none overflows.
MODERATE = st.floats(0.05, 0.95)


def bits(x: float) -> bytes:
    return struct.pack("d", x)


@usersub.coefficient(props=2)
def everything(slip_rate, pressure, temperature, slip_increment, props):
    x, y, z = slip_rate, pressure, temperature
    value = math.exp(-x) * math.log(1.0 + y) / (2.0 + math.sin(z)) + math.sqrt(x * y) - 3 * x
    value += x**2 + y**3 - x**-2 + x**1.7 + y**z + 2.0**x + (x + y) / (3 - z) - 1 / (1 + x)
    value = value * math.tanh(x - z) - math.atan2(x, y) + math.hypot(x, 2.0 * y) + abs(z - 2.0)
    value += max(x, y, z) - min(x, y, 0.5) + np.sqrt(x) * np.exp(-y) + np.maximum(x, z)
    value += math.expm1(-x) + math.log1p(y) + math.cosh(x) - math.sinh(y) + math.atan(z)
    value += math.asinh(x) + math.asin(x) + math.acos(y) + math.atanh(z) + math.acosh(1.0 + x)
    value += math.erf(x) - math.erfc(y) + math.cos(z) + math.tan(x) + math.log10(y) + math.log2(z)
    value += (5.0 * x) % 2.0 + (7 * y) // 2 + math.floor(9.0 * z) + int(4.0 * x) + np.arctan(y)
    if x > y:
        value = -value + props[0]
    elif z != x and not y > z:
        value -= props[1] * slip_increment
    return value + slip_increment * x


def exact(x, y, z, s, props):
    """The same, written in mpmath."""
    value = mp.exp(-x) * mp.log(1 + y) / (2 + mp.sin(z)) + mp.sqrt(x * y) - 3 * x
    value += x**2 + y**3 - x**-2 + x ** mpf(1.7) + y**z + mpf(2) ** x + (x + y) / (3 - z)
    value -= 1 / (1 + x)
    value = value * mp.tanh(x - z) - mp.atan2(x, y) + mp.hypot(x, 2 * y) + abs(z - 2)
    value += max(x, y, z) - min(x, y, mpf(0.5)) + mp.sqrt(x) * mp.exp(-y) + max(x, z)
    value += mp.expm1(-x) + mp.log1p(y) + mp.cosh(x) - mp.sinh(y) + mp.atan(z)
    value += mp.asinh(x) + mp.asin(x) + mp.acos(y) + mp.atanh(z) + mp.acosh(1 + x)
    value += mp.erf(x) - mp.erfc(y) + mp.cos(z) + mp.tan(x) + mp.log10(y) + mp.log(z, 2)
    value += (5 * x) % 2 + mp.floor(7 * y / 2) + mp.floor(9 * z) + mp.floor(4 * x) + mp.atan(y)
    if x > y:
        value = -value + props[0]
    elif not y > z:
        value -= props[1] * s
    return value + s * x


def slopes(x, y, z, s, props):
    """Derivatives by central differences in 60 digits: their error is below 1e-19."""
    h = mpf(10) ** -20
    found = []
    for k in range(4):
        ends = []
        for sign in (1, -1):
            moved = [mpf(v) for v in (x, y, z, s)]
            moved[k] += sign * h
            ends.append(exact(*moved, props))
        found.append((ends[0] - ends[1]) / (2 * h))
    return found


@pytest.mark.parametrize("compiled", [False, True], ids=["interpreter", "machine"])
@given(x=MODERATE, y=MODERATE, z=MODERATE, s=st.floats(-2.0, 2.0))
def test_value_is_that_of_the_plain_call_and_derivatives_are_true(compiled, x, y, z, s):
    corners = (x - y, x - z, y - z, x - 0.5, y - 0.5, (5 * x) % 2, (7 * y) % 2, (9 * z) % 1,
               (4 * x) % 1)  # fmt: skip
    assume(all(min(abs(c), abs(c - 2), abs(c - 1)) > 1e-3 for c in corners))
    given_ = {"slip_rate": x, "pressure": y, "temperature": z, "slip_increment": s,
              "props": [0.3, 0.7]}  # fmt: skip
    plain = everything.value(**given_, compiled=compiled)
    value, by = everything.derivatives(**given_, compiled=compiled)
    assert bits(value) == bits(plain)
    with workdps(60):
        truth = [float(d) for d in slopes(x, y, z, s, [mpf(0.3), mpf(0.7)])]
    # Each term is good to a few ulp; terms up to 1e4 (x**-3) cancel.
    size = 1.0 + max(abs(t) for t in truth)
    assert list(by.values()) == pytest.approx(truth, rel=1e-10, abs=1e-12 * size)


#: One-variable functions of the table with a range that numbers of any size may come from.
WIDE = {
    "exp": (-800, 800), "expm1": (-800, 800), "log": (1e-300, 1e300), "log1p": (-0.999, 1e300),
    "log2": (1e-300, 1e300), "log10": (1e-300, 1e300), "sqrt": (0, 1e300), "sin": (-1e5, 1e5),
    "cos": (-1e5, 1e5), "tan": (-1e5, 1e5), "asin": (-1, 1), "acos": (-1, 1),
    "atan": (-1e300, 1e300), "sinh": (-800, 800), "cosh": (-800, 800), "tanh": (-1e300, 1e300),
    "asinh": (-1e300, 1e300), "acosh": (1, 1e300), "atanh": (-0.999999, 0.999999),
    "erf": (-1e3, 1e3), "erfc": (-30, 30), "degrees": (-1e300, 1e300), "radians": (-1e300, 1e300),
    "square": (-1e150, 1e150), "exp2": (-1100, 1100), "cbrt": (-1e300, 1e300),
}  # fmt: skip

#: Of these numba knows numpy's spelling alone.
NUMPY = ("exp2", "cbrt", "degrees", "radians", "square")

_LAWS: dict[str, usersub.LawFunction] = {}


def law_of(name: str) -> usersub.LawFunction:
    """A law that is one function of the table; numba knows some of them as numpy's only."""
    if name not in _LAWS:
        function = getattr(np if name in NUMPY else math, name)

        def law(slip_rate):
            return function(slip_rate)

        _LAWS[name] = usersub.coefficient(law)
    return _LAWS[name]


def test_every_function_of_the_table_is_tried():
    assert WIDE.keys() == rules.ONE.keys()


@pytest.mark.parametrize("name", WIDE)
@given(data=st.data())
def test_values_of_functions_have_the_bits_of_the_plain_call(name, data):
    x = data.draw(st.floats(*WIDE[name]))
    law = law_of(name)
    plain = law.value(slip_rate=x, compiled=True)
    value, by = law.derivatives(slip_rate=x, compiled=True)
    assert bits(value) == bits(plain)
    if not math.isfinite(value) or name in NUMPY:
        return
    try:
        plainest = getattr(math, name)(x)
    except OverflowError:
        return
    assert value == pytest.approx(plainest, rel=4e-16, abs=5e-324)
    own_value, own = law.derivatives(slip_rate=x)
    assert bits(own_value) == bits(plainest)
    assert by["slip_rate"] == pytest.approx(own["slip_rate"], rel=1e-13, abs=1e-320)


@pytest.mark.parametrize("name", WIDE)
def test_derivatives_of_functions_over_their_range(name):
    low, high = WIDE[name]
    law = law_of(name)
    with workdps(900):
        function = getattr(mp, name, None) or {
            "exp2": lambda x: mpf(2) ** x, "log2": lambda x: mp.log(x, 2),
            "square": lambda x: x * x,
        }[name]  # fmt: skip
        for share in (0.003, 0.11, 0.37, 0.5001, 0.83, 0.998):
            x = low + share * (high - low) if high < 1e10 else 10.0 ** (share * 12 - 5)
            value, by = law.derivatives(slip_rate=x, compiled=True)
            if not math.isfinite(value) or name == "cbrt" and x < 0:
                continue
            h = mpf(x) * mpf(10) ** -300
            truth = (function(x + h) - function(x - h)) / (2 * h)
            if abs(truth) < 1e-290:
                assert abs(by["slip_rate"]) < 1e-289
                continue
            # Rounding of the argument of a derivative rule is amplified near the ends of a range.
            assert by["slip_rate"] == pytest.approx(float(truth), rel=2e-12)


@given(
    x=st.floats(1e-3, 1e3),
    n=st.integers(-9, 9),
    y=st.floats(-30.0, 30.0).filter(lambda y: abs(y) > 1e-3),
)
def test_powers(x, n, y):
    value, by = whole.derivatives(slip_rate=x, props=[n], compiled=True)
    assert bits(value) == bits(whole.value(slip_rate=x, props=[n], compiled=True))
    assert value == pytest.approx(float(mpf(x) ** n), rel=1e-14)
    assert by["slip_rate"] == pytest.approx(float(n * mpf(x) ** (n - 1)), rel=1e-14)
    value, by = real_power.derivatives(slip_rate=x, pressure=y, compiled=True)
    assert bits(value) == bits(real_power.value(slip_rate=x, pressure=y, compiled=True))
    truth = mpf(x) ** mpf(y)
    assert by["slip_rate"] == pytest.approx(float(y * truth / x), rel=1e-13)
    assert by["pressure"] == pytest.approx(float(truth * mp.log(x)), rel=1e-12, abs=1e-300)


@usersub.coefficient(props=1)
def whole(slip_rate, props):
    return slip_rate ** int(props[0])


@usersub.coefficient
def real_power(slip_rate, pressure):
    return slip_rate**pressure


def test_powers_at_zero():
    by = {}
    for n in (0, 1, 2, 3):
        by[n] = whole.derivatives(slip_rate=0.0, props=[n], compiled=True)[1]["slip_rate"]
    assert by == {0: 0.0, 1: 1.0, 2: 0.0, 3: 0.0}
    for compiled in (False, True):
        found = {
            y: real_power.derivatives(slip_rate=0.0, pressure=y, compiled=compiled)[1]
            for y in (0.5, 1.0, 1.5)
        }
        assert found[0.5] == {"slip_rate": math.inf, "pressure": 0.0}
        assert found[1.0] == {"slip_rate": 1.0, "pressure": 0.0}
        assert found[1.5] == {"slip_rate": 0.0, "pressure": 0.0}


def test_a_small_power_keeps_the_digits_of_its_derivative():
    # x**1.7 is zero in floating point, its derivative is not.
    @usersub.coefficient
    def law(slip_rate):
        return slip_rate**1.7

    by = law.derivatives(slip_rate=1e-200, compiled=True)[1]["slip_rate"]
    assert by == pytest.approx(1.7e-140, rel=1e-12)


def test_a_number_and_a_dual_in_turn():
    @usersub.coefficient(props=1)
    def law(slip_rate, pressure, props):
        found = 0
        for k in range(3):
            if slip_rate > k:
                found = found + slip_rate * pressure
            else:
                found = 2 * found
        pair = (0.0, found) if pressure > 1.0 else (found, 1)
        first, second = pair
        return first + second

    for compiled in (False, True):
        value, by = law.derivatives(slip_rate=1.5, pressure=2.0, props=[0], compiled=compiled)
        assert value == 12.0
        assert by == {"slip_rate": 8.0, "pressure": 6.0}


LOST = [
    ("float(slip_rate)", "float\\(\\) of a quantity that carries derivatives would lose them"),
    ("complex(slip_rate)", "complex\\(\\) of a quantity that carries derivatives"),
    ("math.gamma(slip_rate)", "math.gamma has no derivative rule"),
    ("math.lgamma(slip_rate)", "math.lgamma has no derivative rule"),
    ("np.spacing(slip_rate)", "numpy.spacing has no derivative rule"),
    ("kept(slip_rate)", "would lose the derivatives of what is stored in it|float\\(\\) of a"),
]


def kept(x):
    array = np.zeros(2)
    array[0] = x
    return array[0]


@pytest.mark.parametrize(("expression", "told"), LOST, ids=[e for e, _ in LOST])
def test_nothing_loses_its_derivative_silently(expression, told, tmp_path):
    file = tmp_path / "law.py"
    file.write_text(
        "import math\nimport numpy as np\nimport usersub\n"
        "from tests.unit.test_lift_duals import kept\n\n"
        f"@usersub.coefficient\ndef law(slip_rate):\n    return {expression}\n"
    )
    law = usersub.load(file)["fric_coef"]
    with pytest.raises(CompileError, match=told) as raised:
        law.entry()
    assert "law.py:8" in str(raised.value)
    from usersub.routine.pyfile import _run

    with pytest.raises(ContractError, match=told):
        _run(file).law.derivatives(slip_rate=0.5)


ANY = st.floats(allow_nan=True, allow_infinity=True)

PLAIN = {
    "sum": lambda x, y: x + y,
    "difference": lambda x, y: 3.0 - x - y,
    "product": lambda x, y: -x * y,
    "quotient": lambda x, y: x / y,
    "largest": lambda x, y: max(0.0, x, y),
    "smallest": lambda x, y: min(x, y, -0.0),
    "size": lambda x, y: math.hypot(x, y),
    "angle": lambda x, y: math.atan2(x, y),
    "sign": lambda x, y: math.copysign(x, y),
    "power": lambda x, y: abs(x) ** y,
    "square root": lambda x, y: abs(x) ** 0.5 + 2.0**y,
}


@pytest.fixture(scope="module")
def plain_laws():
    return {name: usersub.coefficient(_bound(function)) for name, function in PLAIN.items()}


def _bound(function):
    def law(slip_rate, pressure):
        return function(slip_rate, pressure)

    return law


@pytest.mark.parametrize("name", PLAIN)
@given(x=ANY, y=ANY)
def test_any_numbers_give_the_bits_of_the_plain_call(plain_laws, name, x, y):
    law = plain_laws[name]
    plain = law.value(slip_rate=x, pressure=y, compiled=True)
    value, _ = law.derivatives(slip_rate=x, pressure=y, compiled=True)
    # The sign and payload of NaN are left open by the processor's own arithmetic.
    assert bits(value) == bits(plain) or (math.isnan(value) and math.isnan(plain))


def test_a_function_that_only_numpy_spells_for_numba():
    @usersub.coefficient
    def law(slip_rate):
        return math.cbrt(slip_rate)

    assert law.derivatives(slip_rate=8.0)[1]["slip_rate"] == pytest.approx(1.0 / 12.0, rel=1e-15)
    with pytest.raises(CompileError, match=r"numba does not know math\.cbrt; use numpy\.cbrt"):
        law.derivatives(slip_rate=8.0, compiled=True)
