# SPDX-License-Identifier: MIT
"""C laws whose derivatives come from the same source, read once more as C++."""

from __future__ import annotations

import ctypes
import math
import os

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from mpmath import mpf

import usersub
from tests.unit.c_laws import PLAIN, SOURCES
from usersub.errors import CompileError, MissingTool

#: What the law of expressions is asked: value without and with derivatives.
PROBE = """
#ifndef USUB_DUAL_PASS
void probe(const double *x, const double *props, double *plain, double *dual) {
  *plain = usub_law(x[0], x[1], x[2], NULL, x[3], 0, NULL, props, 1, NULL);
  *dual = usub_law_dual(x[0], x[1], x[2], NULL, x[3], 0, NULL, props, 1, dual + 1);
}
#endif
"""


def c_round(y):
    """As C rounds: halves go away from zero."""
    return mpmath.sign(y) * mpmath.floor(abs(y) + mpf(0.5))


#: C expressions in x = rate and y = pressure, the same in mpmath, and where they may be asked.
POSITIVE, ANY = (1 / 16, 40.0), (-20.0, 20.0)
INSIDE, ABOVE, INDEX = (-15 / 16, 15 / 16), (17 / 16, 30.0), (0.0, 7 / 8)
EXPRESSIONS = {
    "x + y * x - y": (lambda x, y: x + y * x - y, ANY, ANY),
    "x / y + 2 / y - x / 3": (lambda x, y: x / y + 2 / y - x / 3, ANY, POSITIVE),
    "-x * 2.5f + (+y)": (lambda x, y: -x * mpf(2.5) + y, ANY, ANY),
    "exp(x)": (lambda x, y: mpmath.exp(x), ANY, ANY),
    "exp2(x)": (lambda x, y: mpf(2) ** x, ANY, ANY),
    "expm1(x)": (lambda x, y: mpmath.expm1(x), ANY, ANY),
    "log(x)": (lambda x, y: mpmath.log(x), POSITIVE, ANY),
    "log2(x)": (lambda x, y: mpmath.log(x, 2), POSITIVE, ANY),
    "log10(x)": (lambda x, y: mpmath.log(x, 10), POSITIVE, ANY),
    "log1p(x)": (lambda x, y: mpmath.log1p(x), POSITIVE, ANY),
    "sqrt(x)": (lambda x, y: mpmath.sqrt(x), POSITIVE, ANY),
    "cbrt(x)": (lambda x, y: mpmath.cbrt(x), POSITIVE, ANY),
    "pow(x, y)": (lambda x, y: x**y, POSITIVE, ANY),
    "pow(x, 3)": (lambda x, y: x**3, ANY, ANY),
    "pow(x, 2) + pow(y, -1)": (lambda x, y: x**2 + 1 / y, ANY, POSITIVE),
    "pow(x, 2 + 0 * props[0]) + pow(x, 1)": (lambda x, y: x**2 + x, ANY, ANY),
    "pow(x, -1.5)": (lambda x, y: x ** mpf(-1.5), POSITIVE, ANY),
    "pow(2, y)": (lambda x, y: mpf(2) ** y, ANY, ANY),
    "hypot(x, y)": (lambda x, y: mpmath.hypot(x, y), ANY, POSITIVE),
    "hypot(x, 2)": (lambda x, y: mpmath.hypot(x, 2), ANY, ANY),
    "atan2(x, y)": (lambda x, y: mpmath.atan2(x, y), ANY, POSITIVE),
    "atan2(1, y)": (lambda x, y: mpmath.atan2(1, y), ANY, POSITIVE),
    "sin(x) * cos(y)": (lambda x, y: mpmath.sin(x) * mpmath.cos(y), ANY, ANY),
    "tan(x)": (lambda x, y: mpmath.tan(x), INSIDE, ANY),
    "asin(x) + acos(y)": (lambda x, y: mpmath.asin(x) + mpmath.acos(y), INSIDE, INSIDE),
    "atan(x)": (lambda x, y: mpmath.atan(x), ANY, ANY),
    "sinh(x)": (lambda x, y: mpmath.sinh(x), ANY, ANY),
    "cosh(x)": (lambda x, y: mpmath.cosh(x), ANY, ANY),
    "tanh(x)": (lambda x, y: mpmath.tanh(x), ANY, ANY),
    "asinh(x)": (lambda x, y: mpmath.asinh(x), ANY, ANY),
    "acosh(x)": (lambda x, y: mpmath.acosh(x), ABOVE, ANY),
    "atanh(x)": (lambda x, y: mpmath.atanh(x), INSIDE, ANY),
    "erf(x) + erfc(y)": (lambda x, y: mpmath.erf(x) + mpmath.erfc(y), INSIDE, INSIDE),
    "fabs(x) * y": (lambda x, y: abs(x) * y, ANY, ANY),
    "fmin(x, y) + fmax(x, 2)": (lambda x, y: min(x, y) + max(x, 2), ANY, ANY),
    "fdim(x, y)": (lambda x, y: max(x - y, mpf(0)), ANY, ANY),
    "fma(x, y, x)": (lambda x, y: x * y + x, ANY, ANY),
    "fmod(x, 3)": (lambda x, y: x - 3 * int(x / 3), POSITIVE, ANY),
    "copysign(x, y)": (lambda x, y: abs(x) * mpmath.sign(y), ANY, ANY),
    "floor(x) * y + ceil(y) * x": (
        lambda x, y: mpmath.floor(x) * y + mpmath.ceil(y) * x, ANY, ANY,
    ),
    "trunc(x) + round(y) * x": (lambda x, y: int(x) + c_round(y) * x, ANY, ANY),
    "x > y ? x * x : y * 3": (lambda x, y: x * x if x > y else 3 * y, ANY, ANY),
    "x > 0 && !(y >= 1) && x != 2 ? x : 0": (
        lambda x, y: x if x > 0 and y < 1 else mpf(0), ANY, ANY,
    ),
    "usub_plain(x) * y": (lambda x, y: None, ANY, ANY),
    "isfinite(x) && !isnan(y) ? x * props[(int)y] : y": (lambda x, y: None, ANY, INDEX),
    "usub_bounded_exp(-x * x)": (lambda x, y: mpmath.exp(-x * x), ANY, ANY),
    "usub_ratio(x, y) + usub_abs(x)": (lambda x, y: x / y + abs(x), ANY, POSITIVE),
    "usub_smaller(x, 2 * y)": (lambda x, y: min(x, 2 * y), ANY, ANY),
}  # fmt: skip


def law_of(expressions) -> str:
    """A law that answers expression number props(1)."""
    cases = "\n".join(f"  case {i}: return {e};" for i, e in enumerate(expressions))
    return (
        '#define USUB_LAW "expressions"\n#define USUB_LAW_PROPS 1\n#define USUB_LAW_DUAL\n'
        "#define USUB_LAW_READS_RATE\n#define USUB_LAW_READS_PRESSURE\n"
        "#include <usersub/strength_law.h>\n"
        "USUB_LAW_FUNCTION {\n  const usub_value x = rate, y = pressure;\n"
        f"  switch ((int)props[0]) {{\n{cases}\n  }}\n  return 0;\n}}\n{PROBE}"
    )


@pytest.fixture(scope="module")
def ask(tmp_path_factory):
    """Function (expression, x, y) to value, value with derivatives, derivatives."""
    names = [*EXPRESSIONS, *(e for e, _, _ in KINKS)]
    path = tmp_path_factory.mktemp("duals") / "expressions.c"
    path.write_text(law_of(names))
    file = usersub.load(path)
    probe = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 4)(file.symbol("probe"))

    def call(expression: str, x: float, y: float):
        at, props = np.array([x, y, 0.0, 0.0]), np.array([float(names.index(expression))])
        plain, dual = np.zeros(1), np.zeros(5)
        probe(*[a.ctypes.data for a in (at, props, plain, dual)])
        return plain[0], dual[0], dual[1:]

    call.file = file
    return call


@pytest.mark.parametrize("expression", EXPRESSIONS)
@given(data=st.data())
def test_values_and_derivatives(ask, expression, data):
    """Bits of the value; derivatives within the rounding of the slope's own formula."""
    truth, *ranges = EXPRESSIONS[expression]
    # not closer to zero than the steps of the differences; kinks at zero are below
    x, y = (
        data.draw(st.floats(*r).filter(lambda v: abs(v) > 1e-6), label=name)
        for name, r in zip("xy", ranges, strict=True)
    )
    assume(x != y or "?" not in expression)  # there the branch decides
    plain, value, derivatives = ask(expression, x, y)
    assert np.float64(plain).tobytes() == np.float64(value).tobytes()
    if "plain" in expression:
        np.testing.assert_array_equal(derivatives, [0, x, 0, 0])
        return
    if "isfinite" in expression:
        np.testing.assert_array_equal(derivatives[1:], 0)
        return
    # one-sided from above, so that kinks that are hit are right too
    x, y, h = mpf(x), mpf(y), mpf(10) ** -40
    by_x = (truth(x + h, y) - truth(x, y)) / h
    by_y = (truth(x, y + h) - truth(x, y)) / h
    expected = np.array([float(by_x), float(by_y)])
    assume((np.abs(expected) < 1e20).all())  # a step has no slope
    # slopes of one that cancel leave their rounding
    size = max(abs(value), 1.0) if "usub_abs" in expression else abs(value)
    np.testing.assert_allclose(derivatives[:2], expected, rtol=2e-13, atol=1e-14 * size)
    np.testing.assert_array_equal(derivatives[2:], 0)


#: (expression, (x, y), derivatives by x and y), at kinks and where a slope is infinite.
KINKS = [
    ("fabs(x - 1)", (1.0, 0.0), (1, 0)),
    ("fabs(1 - x)", (1.0, 0.0), (1, 0)),
    ("fmax(x, 2 * y - 3)", (3.0, 3.0), (1, 2)),
    ("fmin(x, 2 * y - 3)", (3.0, 3.0), (0, 0)),
    ("fmax(3 - x, 1)", (2.0, 0.0), (0, 0)),
    ("fmin(1, 3 - x)", (2.0, 0.0), (-1, 0)),
    ("fdim(x, y) * 2", (2.0, 2.0), (2, 0)),
    ("hypot(x, 3 * y)", (0.0, 0.0), (1, 3)),
    ("sqrt(x) + y", (0.0, 2.0), (math.inf, 1)),
    ("sqrt(y) + x", (1.0, 0.0), (1, math.inf)),
    ("pow(x, 0.5) * y", (0.0, 2.0), (math.inf, 0)),
    ("pow(x, 1)", (0.0, 2.0), (1, 0)),
    ("pow(x, 0)", (0.0, 2.0), (0, 0)),
    ("pow(x, 2)", (0.0, 2.0), (0, 0)),
    ("pow(x, y)", (0.0, 2.0), (0, 0)),
    ("x < 2 ? x : 5 * x - 8", (2.0, 0.0), (5, 0)),
    ("x > 2 ? x : 5 * x - 8", (2.0, 0.0), (5, 0)),
    ("usub_ratio(x, y)", (2.0, 0.0), (0, 0)),
    ("usub_bounded_exp(-x)", (900.0, 0.0), (0, 0)),
]


@pytest.mark.parametrize(("expression", "at", "expected"), KINKS)
def test_kinks(ask, expression, at, expected):
    plain, value, derivatives = ask(expression, *at)
    assert plain == value
    np.testing.assert_array_equal(derivatives[:2], expected)


STATE_PROBE = """
#ifndef USUB_DUAL_PASS
void probe(const double *x, const double *fields, double *state, const double *props,
           double *plain, double *dual) {{
  double old[2] = {{state[0], state[1]}}, d[2][4] = {{{{0}}}};
  {plain};
  {dual};
  for (int i = 0; i < 2; ++i) {{ dual[2 + i] = state[i]; plain[2 + i] = old[i]; }}
}}
#endif
"""
_ARGUMENTS = "(x[0], x[1], x[2], fields, x[3], x[4], {state}, props, 6, {output})"


@pytest.mark.parametrize("name", ["worn", "plain", "cohesive", "viscous", "planks", "capped"])
def test_laws_have_the_same_bits_with_and_without_derivatives(tmp_path, name):
    """Values and state variables at a thousand points of every magnitude."""
    source = SOURCES[name]
    pair = name == "planks"
    plain = "usub_law" + _ARGUMENTS.format(state="old", output="plain, NULL" if pair else "NULL")
    dual = "usub_law_dual" + _ARGUMENTS.format(state="state", output="dual, d" if pair else "d[0]")
    if not pair:
        plain, dual = f"plain[0] = {plain}", f"dual[0] = {dual}"
    path = tmp_path / f"{name}.c"
    path.write_text(source.text(dual=True) + STATE_PROBE.format(plain=plain, dual=dual))
    probe = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 6)(usersub.load(path).symbol("probe"))
    generator = np.random.default_rng(23)
    props = np.array([*source.law.props, *[0.0] * 6])
    for _ in range(1000):
        x = 10.0 ** generator.uniform(-9, 4, 5)
        fields, state = generator.uniform(0, 2, 2), generator.uniform(0, 3, 2)
        one, other = np.zeros(4), np.zeros(4)
        probe(*[a.ctypes.data for a in (x, fields, state, props, one, other)])
        assert one.tobytes() == other.tobytes()


def test_a_missing_cxx_compiler_is_one_sentence(tmp_path, monkeypatch):
    path = tmp_path / "law.c"
    path.write_text(PLAIN.text(dual=True) + "/* not in the cache */ int unseen;\n")
    monkeypatch.setenv("CXX", "no-such-compiler")
    with pytest.raises(MissingTool) as caught:
        usersub.load(path)
    words = str(caught.value)
    assert words.startswith("law.c defines USUB_LAW_DUAL, so its derivatives take a C++ compiler")
    assert "CXX names the C++ compiler 'no-such-compiler'" in words
    assert "\n" not in words


def test_without_dual_no_cxx_compiler_is_needed(tmp_path, monkeypatch):
    path = tmp_path / "law.c"
    path.write_text(PLAIN.text() + "int unseen_too;\n")
    monkeypatch.setenv("CXX", "no-such-compiler")
    assert "vfric_coef" in usersub.load(path)
    path.write_text(PLAIN.text(dual=True) + "int unseen_as_well;\n")
    assert "vfric_coef" in usersub.load(path, precision="single")  # which has no derivatives


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("  const double lost = rate;", "law.c:12:"),
        ("  const usub_value *x = props[0] > 0 ? props : (void *)0; (void)x;", "law.c:12:"),
    ],
)
def test_what_is_c_but_not_cxx_is_refused_with_its_line(tmp_path, line, words):
    text = PLAIN.text(dual=True).replace("  (void)0;", line)
    where = next(i for i, row in enumerate(text.splitlines(), 1) if row == line)
    path = tmp_path / "law.c"
    path.write_text(text)
    with pytest.raises(CompileError) as caught:
        usersub.load(path)
    assert f"law.c:{where}:" in str(caught.value)
    assert "it is read as C++ too, since it defines USUB_LAW_DUAL" in str(caught.value)


def test_a_law_in_cxx(tmp_path):
    """The same file as C++ for both readings: the same numbers."""
    made = []
    for suffix in (".c", ".cpp"):
        path = tmp_path / f"law{suffix}"
        path.write_text(PLAIN.text(dual=True))
        scene = usersub.Scene(points=2, props=PLAIN.law.props, fields=2, characteristic_length=1.0)
        driver = usersub.StandardDriver(usersub.load(path)["fric_coef"], scene)
        field = np.full((2, 2), 0.25, order="F")
        driver.bind(field_secondary=field, field_main=field, pressure=np.array([3.0, 4.0]))
        driver.begin_increment(0.5)
        made.append(driver.iterate(slip_increment=np.asfortranarray([[0.1, 0.2], [0.3, 0.5]])))
    for name in ("tau", "ddtddg", "ddtddp"):
        np.testing.assert_array_equal(getattr(made[0], name), getattr(made[1], name))


def test_the_cache_knows_the_second_reading(tmp_path):
    """A change that only the second reading sees makes another library."""
    made = set()
    for factor in (1, 2):
        (tmp_path / "own.h").write_text(
            f"#ifdef __cplusplus\nstatic const int own = {factor};\n#endif\n"
        )
        path = tmp_path / "law.c"
        path.write_text('#include "own.h"\n' + PLAIN.text(dual=True))
        made.add(os.fspath(usersub.load(path).code.build("double").library))
    assert len(made) == 2
