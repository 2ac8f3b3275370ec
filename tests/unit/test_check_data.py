# SPDX-License-Identifier: MIT
"""Rules about data that outlive a call, and about data that were never set."""

from __future__ import annotations

import pytest
from check_routines import BODY_C, BODY_FORTRAN, found, in_c, in_fortran, subject, written

from usersub.check.rule import NotApplicable
from usersub.check.source import statics

pytestmark = pytest.mark.usefixtures("fortran")


@pytest.mark.parametrize("rule", ["data.shared", "data.size", "data.uninitialised"])
def test_whole_routines_pass(tmp_path, rule):
    for path in (in_c(tmp_path), in_fortran(tmp_path)):
        assert found(rule, subject(path)) == []


def test_what_is_written_is_named_with_its_place(tmp_path):
    path = in_c(tmp_path, BODY_C + " count++;", above="static int count;")
    (finding,) = found("data.shared", subject(path))
    assert "refers to variable count (4 bytes), which outlives a call" in finding.detail
    assert finding.where == "law.c:5"


def test_common_and_save_are_named_with_their_places(tmp_path):
    above = "COMMON /KBLK/ XLAST\nSAVE NCALLS"
    body = BODY_FORTRAN + "+XLAST*NCALLS\nXLAST = FCOEF(K)\nNCALLS = NCALLS + 1"
    (finding,) = found("data.shared", subject(in_fortran(tmp_path, body, above=above)))
    assert "COMMON /KBLK/ (8 bytes) and variable ncalls (4 bytes), which outlive" in finding.detail
    assert finding.where == "law.f:7"


def test_constant_tables_are_no_state(tmp_path):
    fortran = in_fortran(
        tmp_path, "FCOEF(K) = TABLE(MOD(K,3)+1)", above="DIMENSION TABLE(3)\nDATA TABLE/.1,.2,.3/"
    )
    c = in_c(tmp_path, "fCoef[k] = table[k % 3];", above="static double table[3] = {.1, .2, .3};")
    for path in (fortran, c):
        assert found("data.shared", subject(path)) == []


def test_data_of_other_entries_of_the_file_are_theirs(tmp_path):
    path = in_fortran(tmp_path)
    text = path.read_text(encoding="ascii")
    other = "      SUBROUTINE UAMP(X)\n      COMMON /ITS/ Y\n      Y = X\n      END\n"
    assert found("data.shared", subject(written(path, text + other))) == []


def test_large_local_arrays_are_not_static(tmp_path):
    # Larger than what is left on the stack by default; the solver's compiler keeps it local.
    path = in_fortran(
        tmp_path, "WORK(K) = 0\n" + BODY_FORTRAN + "+WORK(K)", above="DIMENSION WORK(400000)"
    )
    assert found("data.shared", subject(path)) == []


def test_static_memory_is_summed_over_the_file(tmp_path):
    path = in_c(tmp_path, BODY_C + " big[k] = 1;", above="double big[3 << 20];")
    (finding,) = found("data.size", subject(path))
    assert "24 MiB of static memory, most of it in variable big" in finding.detail
    assert "expected at most 16 MiB" in finding.detail
    small = in_c(tmp_path, BODY_C + " big[k] = 1;", above="double big[1 << 20];")
    assert found("data.size", subject(small)) == []


def test_python_routines_have_none(tmp_path):
    path = written(
        tmp_path / "law.py",
        "import usersub\n@usersub.vfric_coef\ndef law(fCoef, props):\n    fCoef[:] = props[0]\n",
    )
    with pytest.raises(NotApplicable):
        found("data.shared", subject(path))


def test_bytes_in_words():
    assert statics.bytes_in_words(8) == "8 bytes"
    assert statics.bytes_in_words(3 << 20) == "3 MiB"


def test_an_unset_local_is_found_and_named(tmp_path):
    c = in_c(tmp_path, "double mu; if (slipRate[k] > 1e-3) mu = props[0]; fCoef[k] = mu;")
    fortran = in_fortran(tmp_path, "IF (SLIPRT(K).GT.1.D-3) XMU = PROPS(1)\nFCOEF(K) = XMU")
    for path, name, where in ((c, "mu", "law.c:12"), (fortran, "xmu", "law.f:11")):
        (finding,) = found("data.uninitialised", subject(path))
        assert f"the compiler names {name} ({where})" in finding.detail
        assert finding.where == where


def test_a_warning_alone_is_no_fault(tmp_path):
    # The branch that leaves it unset cannot be taken together with the one that uses it.
    body = (
        "double more; if (props[0] > 0) more = 1; double mu = props[0]; "
        "if (props[0] > 0 && pressure[k] > -1e9) mu += 0 * more; fCoef[k] = mu;"
    )
    assert found("data.uninitialised", subject(in_c(tmp_path, body))) == []


def test_what_the_compiler_hides_is_found_by_first_values(tmp_path):
    # GCC takes the only value there is for the variable, and says nothing.
    path = in_c(tmp_path, "double mu; if (slipRate[k] > 1e-3) mu = 0.3; fCoef[k] = mu;")
    (finding,) = found("data.uninitialised", subject(path))
    assert "by what a local variable holds before it is set" in finding.detail
