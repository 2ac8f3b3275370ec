# SPDX-License-Identifier: MIT
"""Rules about coming back: loops, crashes, STOP, and output in every call."""

from __future__ import annotations

import pytest
from check_routines import BODY_C, BODY_FORTRAN, found, in_c, in_fortran, subject, written

from usersub.check.rule import CannotCheck

pytestmark = pytest.mark.usefixtures("fortran")


@pytest.mark.parametrize(
    "rule", ["process.returns", "process.crash", "process.stop", "process.output"]
)
def test_whole_routines_pass(tmp_path, rule):
    for path in (in_c(tmp_path), in_fortran(tmp_path)):
        assert found(rule, subject(path)) == []


def test_a_loop_without_end(tmp_path):
    # Without load the tolerance is zero.
    body = "volatile double e = 1; while (e >= 1e-9 * pressure[k]) e *= 0.5; " + BODY_C
    (finding,) = found("process.returns", subject(in_c(tmp_path, body)))
    assert "did not return" in finding.detail
    assert finding.where.endswith("law.c:12")


def test_an_integer_division_by_zero(tmp_path):
    body = "FCOEF(K) = PROPS(1) + 1.D-9*(100/INT(PRESS(K)*1.D6))"
    (finding,) = found("process.crash", subject(in_fortran(tmp_path, body)))
    assert "integer division by zero" in finding.detail
    assert finding.where.endswith("law.f:10")


@pytest.mark.parametrize("ending", ["CALL XPLB_EXIT", "STOP 3", "CALL EXIT(2)"])
def test_stops_at_rest(tmp_path, ending):
    body = f"IF (SLIPRT(K).EQ.0.D0) {ending}\n{BODY_FORTRAN}"
    (finding,) = found("process.stop", subject(in_fortran(tmp_path, body)))
    assert "the routine ended with" in finding.detail
    assert finding.where == "law.f:10"
    assert finding.case is not None


def test_a_refusal_of_every_call_with_words_is_no_fault(tmp_path):
    body = (
        'if (nProps[0] != 9) { int level = -3; stdb_abqerr_(&level, "NINE PROPERTIES", 0, 0, '
        '" ", 15, 1); } '
    )
    above = "void stdb_abqerr_(int *, char *, int *, double *, char *, long, long);"
    with pytest.raises(CannotCheck, match="it refuses every call: .*NINE PROPERTIES"):
        found("process.stop", subject(in_c(tmp_path, body + BODY_C, above=above)))


def test_an_exception_of_a_python_routine(tmp_path):
    path = written(
        tmp_path / "law.py",
        "import usersub\n@usersub.vfric_coef\ndef law(fCoef, nBlock, props, slipRate):\n"
        "    for k in range(nBlock):\n        if slipRate[k] == 0.0:\n"
        "            raise ValueError('no slip')\n        fCoef[k] = props[0]\n",
    )
    (finding,) = found("process.stop", subject(path))
    assert "no slip" in finding.detail
    assert finding.where.endswith("law.py:6")


@pytest.mark.parametrize(
    "statement",
    [
        'printf("%g\\n", fCoef[k]);',
        'fprintf(stderr, "mu\\n");',
        'FILE *f = fopen("mu.log", "a"); fprintf(f, "%g\\n", fCoef[k]); fclose(f);',
    ],
)
def test_output_of_c_in_every_call(tmp_path, statement):
    (finding,) = found("process.output", subject(in_c(tmp_path, f"{BODY_C} {statement}")))
    assert "bytes in every call" in finding.detail
    assert finding.where in ("law.c:12", "")


@pytest.mark.parametrize("unit", ["6", "7", "*", "15"])
def test_output_of_fortran_in_every_call(tmp_path, unit):
    path = in_fortran(tmp_path, f"{BODY_FORTRAN}\nWRITE({unit},*) FCOEF(K)")
    (finding,) = found("process.output", subject(path))
    assert "VFRIC_COEF writes" in finding.detail
    assert finding.where == "law.f:11"


def test_reading_a_table_in_every_call(tmp_path):
    table = written(tmp_path / "mu.txt", "0.3\n")
    first = f'double mu; FILE *f = fopen("{table}", "r"); if (fscanf(f, "%lf", &mu) != 1) return;'
    path = in_c(tmp_path, "fCoef[k] = mu;", first=f"{first} fclose(f);")
    (finding,) = found("process.output", subject(path))
    assert "reads 4 bytes in every call" in finding.detail


def test_output_of_the_first_call_alone_is_fine(tmp_path):
    path = in_c(tmp_path, BODY_C + ' if (!said++) printf("here\\n");', above="static int said;")
    assert found("process.output", subject(path)) == []


def test_a_warning_of_a_large_load_is_fine(tmp_path):
    path = in_c(tmp_path, BODY_C + ' if (pressure[k] > 1) printf("large\\n");')
    assert found("process.output", subject(path)) == []
