# SPDX-License-Identifier: MIT
"""Vectorised exp, log and pow: errors against mpmath, special values, the same bits everywhere."""

from __future__ import annotations

import ctypes
import math
import subprocess
import sys

import mpmath
import numpy as np
import pytest

import usersub
from usersub.errors import AbiError
from usersub.routine import vector_math

LEAST, LARGEST = 5e-324, 1.7976931348623157e308


def routines(kind) -> dict[str, usersub.Routine]:
    """exp, log and pow of arguments, as VFRIC_COEF routines."""

    @usersub.vfric_coef(vector_math=kind)
    def exp(fCoef, slipRate):
        for k in range(fCoef.shape[0]):
            fCoef[k] = math.exp(slipRate[k])

    @usersub.vfric_coef(vector_math=kind)
    def log(fCoef, slipRate):
        for k in range(fCoef.shape[0]):
            fCoef[k] = math.log(slipRate[k])

    @usersub.vfric_coef(vector_math=kind)
    def power(fCoef, slipRate, pressure):
        for k in range(fCoef.shape[0]):
            fCoef[k] = slipRate[k] ** pressure[k]

    return {"exp": exp, "log": log, "pow": power}


MADE = routines(True)


def called(routine: usersub.Routine, x: np.ndarray, y: np.ndarray, precision="double"):
    """Results for any numbers: the entry is called without a driver, which would refuse NaN."""
    dtype = {"double": np.float64, "single": np.float32}[precision]
    names = [arg.name for arg in routine.interface.args]
    values = {"fCoef": np.full(x.size, -7.0, dtype), "slipRate": x.astype(dtype),
              "pressure": y.astype(dtype), "nBlock": np.array([x.size], np.int32)}  # fmt: skip
    argv = (ctypes.c_void_p * len(names))()
    for name, value in values.items():
        argv[names.index(name)] = value.ctypes.data
    entry = routine.entry(precision)
    assert ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)(entry.address)(argv) == 0
    return values["fCoef"]


def worst(found: np.ndarray, exact: list) -> float:
    """Largest error in units of the last place of the exact result."""
    with mpmath.workprec(200):
        return max(
            float(abs(mpmath.mpf(float(f)) - e) / mpmath.mpf(math.ulp(float(e))))
            for f, e in zip(found, exact, strict=True)
            if np.isfinite(f)
        )


def spread(count: int, seed: int) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Arguments of each function over all of its range: normal, tiny, denormal, near one."""
    random = np.random.default_rng(seed)
    sign = random.choice([-1.0, 1.0], count)
    tiny = sign * 10.0 ** random.uniform(-18, 0, count)
    positive = random.integers(1, 0x7FF << 52, count).view(np.float64)
    denormal = random.integers(1, 1 << 52, count).view(np.float64)
    near = 1.0 + tiny * 0.3
    exponents = random.uniform(-744.0, 709.0, count)
    base = random.uniform(0.01, 100.0, count)
    nothing = np.zeros(count)
    return {
        "exp": (
            np.concatenate([random.uniform(-708, 709.7, count), tiny,
                            random.uniform(-745.1, -708.4, count)]),
            np.concatenate([nothing] * 3),
        ),
        "log": (np.concatenate([positive, denormal, near]), np.concatenate([nothing] * 3)),
        "pow": (
            np.concatenate([base, positive, 1.0 + tiny * 1e-3]),
            np.concatenate([exponents / np.log(base), random.uniform(-1, 1, count),
                            random.uniform(-1e5, 1e5, count)]),
        ),
    }  # fmt: skip


EXACT = {
    "exp": lambda x, y: mpmath.exp(mpmath.mpf(x)),
    "log": lambda x, y: mpmath.log(mpmath.mpf(x)),
    "pow": lambda x, y: mpmath.power(mpmath.mpf(x), mpmath.mpf(y)),
}


@pytest.mark.parametrize("name", ["exp", "log", "pow"])
def test_errors_are_below_one_unit_of_the_last_place(name):
    x, y = spread(700, 3)[name]
    with mpmath.workprec(200):
        exact = [EXACT[name](float(a), float(b)) for a, b in zip(x, y, strict=True)]
    assert worst(called(MADE[name], x, y), exact) < 0.9


SPECIAL = np.array(
    [0.0, 1.0, 2.0, 3.0, 0.5, 1.5, 7.0, 1e300, LEAST, 2.0**53, 2.0**53 + 2, 1e-300, 709.8, 745.2,
     746.0, 800.0, LARGEST, 2.0**52 + 1, 1 - 2.0**-53, 1 + 2.0**-52, math.inf]
)  # fmt: skip
SPECIAL = np.concatenate([SPECIAL, -SPECIAL, [math.nan]])


@pytest.mark.parametrize("name", ["exp", "log", "pow"])
def test_special_values_are_those_of_c(name):
    x, y = (a.ravel() for a in np.meshgrid(SPECIAL, SPECIAL))
    with np.errstate(all="ignore"):
        expected = {"exp": np.exp, "log": np.log}[name](x) if name != "pow" else np.power(x, y)
    found = called(MADE[name], x, y)
    extreme = ~np.isfinite(expected) | (expected == 0)
    np.testing.assert_array_equal(found[extreme], expected[extreme])
    np.testing.assert_array_equal(
        np.signbit(found)[~np.isnan(expected)], np.signbit(expected)[~np.isnan(expected)]
    )
    np.testing.assert_allclose(found[~extreme], expected[~extreme], rtol=4e-16, atol=LEAST)


@pytest.mark.parametrize("kind", [True, pytest.param("libmvec", id="libmvec")])
@pytest.mark.parametrize("name", ["exp", "log", "pow"])
def test_a_point_has_the_same_bits_in_every_block_and_place(name, kind):
    if kind == "libmvec" and vector_math.library() is None:
        pytest.skip("the C library of this machine has no libmvec")
    routine = MADE[name] if kind is True else routines(kind)[name]
    x, y = (a[:200] for a in spread(200, 8)[name])
    whole = called(routine, x, y)
    for block in (1, 7, 64):
        parts = [called(routine, x[i : i + block], y[i : i + block]) for i in range(0, 200, block)]
        assert np.concatenate(parts).tobytes() == whole.tobytes(), block
    for start in (1, 3, 5):  # another place in memory, another remainder
        assert called(routine, x[start:], y[start:]).tobytes() == whole[start:].tobytes()


def test_single_precision_is_that_of_double_precision_rounded():
    x, y = np.linspace(0.1, 30.0, 77), np.linspace(-3.0, 3.0, 77)
    for made in MADE.values():
        a, b = x.astype(np.float32).astype(float), y.astype(np.float32).astype(float)
        rounded = called(made, a, b).astype(np.float32)
        assert called(made, a, b, "single").tobytes() == rounded.tobytes()


def test_what_the_routine_calls_is_vectorised_in_its_copy_only():
    import numba

    @numba.njit
    def helper(x):
        return math.exp(x)

    def body(fCoef, slipRate):
        for k in range(fCoef.shape[0]):
            fCoef[k] = helper(slipRate[k])

    x = np.random.default_rng(2).uniform(-5, 5, 5000)
    exact = called(usersub.vfric_coef(body), x, x)
    vector = called(usersub.vfric_coef(vector_math=True)(body), x, x)
    assert vector.tobytes() == called(MADE["exp"], x, x).tobytes() != exact.tobytes()
    assert np.array([helper(v) for v in x]).tobytes() == exact.tobytes()


def test_a_law_function_can_be_vectorised():
    def law(slip_rate, props):
        return props[0] * math.exp(-props[1] * slip_rate)

    rates = np.linspace(0.0, 40.0, 333)
    found = []
    for kind in (False, True):
        made = usersub.coefficient(props=2, vector_math=kind)(law).vfric_coef
        driver = usersub.CoefficientDriver(made, usersub.Scene(points=333, props=[0.3, 0.1]))
        found.append(driver.evaluate(slip_rate=rates, pressure=np.ones(333)).copy())
    np.testing.assert_allclose(found[1], found[0], rtol=5e-16)
    assert found[1].tobytes() != found[0].tobytes()


def test_an_unknown_kind_is_refused():
    with pytest.raises(AbiError, match="vector_math = 'fast'; expected False, True, 'polynomial'"):
        usersub.vfric_coef(vector_math="fast")(lambda fCoef: None)


def test_code_from_the_cache_works_in_another_process(tmp_path):
    program = """
import math, numpy, usersub

@usersub.vfric_coef(vector_math={kind!r})
def law(fCoef, slipRate):
    for k in range(fCoef.shape[0]):
        fCoef[k] = math.exp(-slipRate[k])
driver = usersub.CoefficientDriver(law, usersub.Scene(points=9))
print(driver.evaluate(slip_rate=numpy.arange(9.0), pressure=numpy.ones(9)).tobytes())
"""
    kinds = [True] + (["libmvec"] if vector_math.library() else [])
    for kind in kinds:
        path = tmp_path / "law.py"
        path.write_text(program.format(kind=kind))
        environment = {"USERSUB_CACHE": str(tmp_path / "cache"), "PATH": "/usr/bin:/bin"}
        said = [
            subprocess.run([sys.executable, str(path)], env=environment, capture_output=True,
                           text=True, check=True).stdout
            for _ in range(2)
        ]  # fmt: skip
        assert said[0] == said[1] != ""
        folder = "numba-libmvec" if kind == "libmvec" else "numba"
        assert list((tmp_path / "cache" / folder).rglob("*.nbc"))
