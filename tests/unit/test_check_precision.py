# SPDX-License-Identifier: MIT
"""Rules about digits that are lost, and about what the compiler says of conversions."""

from __future__ import annotations

import pytest
from check_routines import BODY_C, BODY_FORTRAN, found, in_c, in_fortran, subject, written

from usersub.check.rule import NotApplicable

pytestmark = pytest.mark.usefixtures("fortran")

#: Digits that single precision leaves: 2**-24 is 6e-8, of which the exponential keeps a part.
_SINGLE = ("7 digits, expected 15", "8 digits, expected 15")


@pytest.mark.parametrize("rule", ["precision.digits", "precision.source"])
def test_whole_routines_pass(tmp_path, rule):
    for path in (in_c(tmp_path), in_fortran(tmp_path)):
        assert found(rule, subject(path)) == []


@pytest.mark.parametrize("rule", ["precision.digits", "precision.source"])
def test_single_precision_has_its_own_digits(tmp_path, rule):
    with pytest.raises(NotApplicable, match="7 digits"):
        found(rule, subject(in_fortran(tmp_path), precision="single"))


def test_a_single_local_of_fortran(tmp_path):
    body = BODY_FORTRAN.replace("SLIPRT(K)", "V")
    path = in_fortran(tmp_path, f"V = SLIPRT(K)\n{body}", above="REAL*4 V")
    (finding,) = found("precision.digits", subject(path))
    assert any(words in finding.detail for words in _SINGLE)
    assert finding.where == "law.f:10"
    # The same lines are not told twice.
    assert found("precision.source", subject(path)) == []


def test_explicit_conversions_count_too(tmp_path):
    path = in_fortran(tmp_path, BODY_FORTRAN.replace("SLIPRT(K)", "SNGL(SLIPRT(K))"))
    (finding,) = found("precision.digits", subject(path))
    assert finding.where == "law.f:10"


def test_a_float_of_c(tmp_path):
    path = in_c(tmp_path, "float v = slipRate[k]; " + BODY_C.replace("slipRate[k]", "v"))
    (finding,) = found("precision.digits", subject(path))
    assert any(words in finding.detail for words in _SINGLE)
    assert finding.where == "law.c:12"


def test_a_function_for_floats(tmp_path):
    path = in_c(tmp_path, BODY_C.replace("exp(", "expf("))
    (finding,) = found("precision.digits", subject(path))
    assert finding.where == "law.c:12"


def test_float32_of_python(tmp_path):
    text = (
        "import math\nimport numpy as np\nimport usersub\n@usersub.vfric_coef\n"
        "def law(fCoef, nBlock, props, slipRate):\n    for k in range(nBlock):\n"
        "        v = {}(slipRate[k])\n"
        "        fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * v)\n"
    )
    path = written(tmp_path / "law.py", text.format("np.float32"))
    (finding,) = found("precision.digits", subject(path))
    assert any(words in finding.detail for words in _SINGLE)
    double = written(tmp_path / "double.py", text.format("np.float64"))
    assert found("precision.digits", subject(double)) == []


def test_single_constants_are_a_warning_and_cost_no_digits_of_the_input(tmp_path):
    path = in_fortran(tmp_path, BODY_FORTRAN + " + 0.1*0.5 + 1.E-30 + 2.")
    assert found("precision.digits", subject(path)) == []
    (finding,) = found("precision.source", subject(path))
    # 0.5 and 2. are exact, and of 1.E-30 no digit matters; 0.1 is off by 1.5e-8.
    assert finding.detail.startswith("0.1 (law.f:10) is a constant of single precision")
    assert "0.1D0" in finding.hint


def test_single_constants_of_c(tmp_path):
    path = in_c(tmp_path, BODY_C + " fCoef[k] += 0.1f * 0.5f; /* 0.2f */")
    assert found("precision.digits", subject(path)) == []
    findings = found("precision.source", subject(path))
    assert findings[0].detail.startswith("0.1f (law.c:12) is a constant of single precision")


def test_an_integer_by_its_first_letter(tmp_path):
    path = in_fortran(tmp_path, "MU = PROPS(1)\nFCOEF(K) = MU")
    (finding,) = found("precision.digits", subject(path))
    assert "MU is an integer, as its name begins with M and nothing declares it" in finding.detail
    assert "the result is 0 instead of 0.3" in finding.detail
    assert finding.where == "law.f:10"


def test_whole_numbers_that_are_meant(tmp_path):
    # Period by period: the fraction is what is wanted; the name is that of a number.
    body = "N = SLIPRT(K)/0.25D0\n" + BODY_FORTRAN + " + 0.01D0*(SLIPRT(K)/0.25D0-N)"
    path = in_fortran(tmp_path, body)
    assert found("precision.digits", subject(path)) == []
    (finding,) = found("precision.source", subject(path))
    assert "real values are assigned to integers" in finding.detail
    said = in_fortran(tmp_path, body.replace("SLIPRT(K)/0.25D0\n", "INT(SLIPRT(K)/0.25D0)\n"))
    assert found("precision.source", subject(said)) == []


def test_abs_of_c_is_for_integers(tmp_path):
    path = in_c(tmp_path, BODY_C.replace("slipRate[k]", "abs(slipRate[k])"))
    (finding,) = found("precision.digits", subject(path))
    assert finding.detail.startswith("abs takes an integer, so fractions are cut off")
    assert finding.where == "law.c:12"


def test_divisions_of_whole_constants(tmp_path):
    path = in_fortran(tmp_path, BODY_FORTRAN + "*SLIPRT(K)**(1/3)")
    (finding,) = found("precision.source", subject(path))
    assert "division of whole constants is cut to a whole number in law.f:10" in finding.detail
