# SPDX-License-Identifier: MIT
"""Tangents, entry by entry; differences and their kinks."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.unit.frictions import fails, found, law, made, passes, refuses
from usersub.check.probing.differences import derivative
from usersub.check.subject import Subject

_DG = "DDTDDG[a + n * b] = k * part * ((a == b) - along * other);"
_DP = "DDTDDP[a] = *PRESS < 0 ? 0 : (mu + p * PROPS[0] * weak * 0.1) * along;"


def test_difference_of_a_smooth_function_is_its_derivative() -> None:
    got = derivative(lambda h: np.array([math.sin(0.7 + h), math.exp(30.0 * h)]), 0.7)
    # plateau of central differences in double precision: about the two thirds of its digits
    assert got.value == pytest.approx([math.cos(0.7), 30.0], rel=1e-8)
    assert not got.kink.any()
    assert np.all(np.abs(got.value - [math.cos(0.7), 30.0]) <= 20.0 * got.doubt)


@pytest.mark.parametrize("slope", [1.0, 1e-4])
def test_kink_is_seen(slope: float) -> None:
    got = derivative(lambda h: np.array([1.0 + h + slope * abs(h), 1.0 + h + h * h]), 1.0)
    assert got.kink.tolist() == [True, False]


@pytest.mark.parametrize(
    ("new", "words"),
    [
        (_DG.replace("= k", "= -k"), "opposite sign all entries fit"),
        (_DG.replace("- along * other", ""), r"DDTDDG\(.*\) is .*; expected .* by differences"),
        (_DG.replace("k * part", "k"), r"DDTDDG\(.*\) is .*; expected"),
        (_DG.replace("k * part", "k * part / *DTIME"), "times the time increment all entries fit"),
        ("DDTDDG[a + n * b] = 0 * other;", "all entries are 0"),
    ],
)
def test_tangent_by_motion(c_routine, new: str, words: str) -> None:
    finding = fails(made(c_routine, "fric", _DG, new), "tangent.slip", words)
    given, right = (np.array(finding.figures[name]) for name in ("given", "differences"))
    error = np.array(finding.figures["error"])
    assert error == pytest.approx(np.abs(given - right))


def test_rows_and_columns_are_told(c_routine) -> None:
    finding = fails(
        _skewed(c_routine, exchanged=True),
        "tangent.slip",
        "rows and columns exchanged all entries fit",
    )
    assert "exchange the indices" in finding.hint
    passes(_skewed(c_routine, exchanged=False), "tangent.slip")


def _skewed(c_routine, *, exchanged: bool) -> Subject:
    """A viscous law: stress 1 depends on both motions, stress 2 on its own."""
    place = "b + n * a" if exchanged else "a + n * b"
    source = f"""
#include <usersub/abi.h>
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {{
  const int n = *NFDIR;
  const double m[2][2] = {{{{2, 0.5}}, {{0, 3}}}};
  if (*LM == 2) return;
  *LM = 0;
  for (int a = 0; a < n; ++a) {{
    TAU[a] = DDTDDP[a] = 0;
    for (int b = 0; b < n; ++b) {{
      TAU[a] += m[a][b] * DGAM[b];
      DDTDDG[{place}] = m[a][b];
    }}
  }}
}}
"""
    routine = c_routine("fric", source)
    return Subject("skewed", routine.interface, routine=routine)


@pytest.mark.parametrize(
    ("new", "words", "hint"),
    [
        ("DDTDDP[a] = *PRESS < 0 ? 0 : mu * along;", r"DDTDDP\(1\) is", "add p dmu/dp"),
        ("DDTDDP[a] = 0 * mu;", "all entries are 0", "set DDTDDP"),
        (_DP.replace("weak * 0.1) * along", "weak * 0.1)"), r"DDTDDP\(", "differentiate"),
    ],
)
def test_tangent_by_pressure(c_routine, new: str, words: str, hint: str) -> None:
    finding = fails(made(c_routine, "fric", _DP, new), "tangent.pressure", words)
    assert hint in finding.hint


def test_tangent_by_temperature(c_routine) -> None:
    subject = made(c_routine, "fric", "DDTDDT[a + n] = DDTDDT[a];", "DDTDDT[a + n] = 0;")
    fails(subject, "tangent.temperature", r"DDTDDT\(1,2\) is 0; expected .* of the main surface")
    half = made(c_routine, "fric", "DDTDDT[a] = -0.5 * p", "DDTDDT[a] = -p")
    fails(half, "tangent.temperature", "half of it fits")
    none = made(c_routine, "fric", "DDTDDT[a] = -0.5 * p", "DDTDDT[a] = -0 * p")
    refuses(none, "tangent.temperature", "leaves DDTDDT at 0")
    refuses(none.but(temperatures=False), "tangent.temperature", "without temperatures")


def test_unsymmetric_part_is_told(c_routine) -> None:
    finding = found(made(c_routine, "fric"), "tangent.unsymmetric")
    assert finding is not None
    assert "UNSYMM" in finding.hint


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("fCoefDeriv[0] = -(", "fCoefDeriv[0] = (", "slot 1.*opposite sign fits"),
        ("fCoefDeriv[1] = 0.1", "fCoefDeriv[1] = 0.2", "slot 2.* by the pressure"),
        ("fCoefDeriv[2] = -1e-4;", "", "slot 3, gives 0 .* by the temperature"),
        ("fCoefDeriv[0] =", "fCoefDeriv[5] =", "slots 1"),
    ],
)
def test_derivatives_of_the_coefficient(c_routine, old: str, new: str, words: str) -> None:
    fails(made(c_routine, "fric_coef", old, new), "tangent.coefficient", words)


def test_no_derivatives_at_all_are_told(c_routine) -> None:
    subject = made(c_routine, "fric_coef", "fCoefDeriv[0] = -(", "return; fCoefDeriv[0] = -(")
    refuses(subject, "tangent.coefficient", "leaves fCoefDeriv at 0")


@pytest.mark.parametrize("name", ["slip_weakening", "rate_state_ageing", "anisotropic_tabulated"])
def test_laws_pass(name: str) -> None:
    passes(law(name, "fric_coef"), "tangent.coefficient")
    passes(law(name, "fric"), "tangent.slip tangent.pressure tangent.temperature")
