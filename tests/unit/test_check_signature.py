# SPDX-License-Identifier: MIT
"""Rules about the argument list and the symbols of a file, which call nothing."""

from __future__ import annotations

import re
from pathlib import Path

import check_routines
import pytest
from check_routines import FRIC_LIST, found, in_c, in_fortran, subject, written

from usersub import abi
from usersub.check.rule import CannotCheck, NotApplicable
from usersub.check.subject import Subject

pytestmark = pytest.mark.usefixtures("fortran")

_FIELD = Path(__file__).resolve().parents[1] / "field"
_RULES = ("count", "types", "dimensions", "names", "order")
_HEALTHY = ("fric_char8.f", "fric_coef_tabs.for", "fric_coef_state.f", "vfric_common.for",
            "vfriction_threads.f", "authors/all_explicit.f90", "authors/implicit_none.f",
            "authors/plane.for", "authors/two_files.for", "authors/cards.f",
            "authors/newer_names.for", "vfric_coef_table.c")  # fmt: skip
_INTERFACES = {"fric_coef": "fric_coef", "vfric_coef": "vfric_coef", "vfriction": "vfriction"}


def _fric(folder: Path, declarations: str, statements: str = "LM = 0", text: str = "") -> Subject:
    whole = (text or FRIC_LIST) + f"{declarations}\n      {statements}\n      END\n"
    return subject(written(folder / "law.f", whole), "fric")


def _ignored(rule: str, about: Subject) -> list:
    try:
        return found(rule, about)
    except NotApplicable:
        return []


@pytest.mark.parametrize("name", _HEALTHY)
def test_files_as_people_write_them_pass(name):
    path = _FIELD / name
    text = path.read_text(encoding="latin-1")
    names = [
        n
        for n in abi.NAMES
        if re.search(rf"(?:subroutine\s+|for_name\(\s*){n}\b", text, re.IGNORECASE)
    ]
    for interface in names:
        about = subject(path, interface)
        assert about.routine is not None
        for rule in (*(f"signature.{r}" for r in _RULES), "symbols.entry", "symbols.undefined"):
            assert _ignored(rule, about) == [], rule


def test_a_missing_argument_is_named():
    about = subject(_FIELD / "planted" / "fric_38_arguments.f", "fric")
    (finding,) = found("signature.count", about)
    assert finding.detail == "FRIC has 38 arguments, expected 39; PNEWDT is missing after DDTDDT"
    assert finding.where == "fric_38_arguments.f:3"
    for other in ("types", "dimensions", "names", "order"):
        with pytest.raises(CannotCheck, match=r"see signature\.count"):
            found(f"signature.{other}", about)


def test_an_invented_argument_is_named():
    (finding,) = found("signature.count", subject(_FIELD / "planted" / "vfric_coef_17.c"))
    assert "has 17 arguments, expected 16 (or 19 with the lengths of the names)" in finding.detail
    assert finding.detail.endswith("'extra' after fieldAvg is too many")


def test_all_wrong_kinds_are_told_with_their_places():
    findings = found("signature.types", subject(_FIELD / "planted" / "vfric_coef_kinds.c"))
    assert [f.where for f in findings] == [f"vfric_coef_kinds.c:{n}" for n in (3, 4, 5)]
    assert "is passed by value, expected the address 'int *'" in findings[0].detail
    assert "is float *, expected double * in double precision" in findings[1].detail
    assert "is long *, expected double *" in findings[2].detail


def test_a_missing_typing_rule_is_one_finding():
    about = subject(_FIELD / "planted" / "vfriction_real4.f", "vfriction")
    (finding,) = found("signature.types", about)
    assert "more: each is real*4, expected real*8 in double precision" in finding.detail
    assert "VABA_PARAM.INC" in finding.hint


@pytest.mark.parametrize(
    ("declared", "used", "said"),
    [
        ("PREDEF(NPRED,2)", "PREDEF(1,2)", "(NPRED,2), but the host passes (2,NPRED): rows"),
        ("PREDEF(1,NPRED)", "PREDEF(1,2)", "(1,NPRED), but the host passes (2,NPRED), so that"),
        ("DROT(3,3)", "DROT(1,1)", "(3,3), but the host passes (2,2), so that elements with a"),
        ("DDTDDT(2,NFDIR)", "DDTDDT(1,1)", "(2,NFDIR), but the host passes (NFDIR,2): rows"),
    ],
)
def test_dimensions_that_put_elements_elsewhere(tmp_path, declared, used, said):
    about = _fric(tmp_path, f"      DIMENSION TAU(NFDIR), {declared}", f"TAU(1) = {used}")
    (finding,) = found("signature.dimensions", about)
    assert said in finding.detail
    assert finding.where == "law.f:7"


@pytest.mark.parametrize(
    ("declared", "used"),
    [
        ("PREDEF(*)", "PREDEF(3)"),  # the older declaration
        ("PREDEF(2,*)", "PREDEF(1,2)"),
        ("DDTDDG(2,2)", "DDTDDG(1,1)"),  # right in three dimensions, and so is element (1,1)
        ("DDTDDG(NFDIR,1)", "DDTDDG(1,1)"),
        ("STATEV(20)", "STATEV(1)"),  # only running shows what is touched
        ("COORDS(3)", "COORDS(1)"),
        ("DROT(0:1,2)", "DROT(0,1)"),
    ],
)
def test_dimensions_that_put_elements_where_they_are(tmp_path, declared, used):
    about = _fric(tmp_path, f"      DIMENSION TAU(NFDIR), {declared}", f"TAU(1) = {used}")
    assert found("signature.dimensions", about) == []


def test_dimensions_by_variables_of_ones_own_are_not_judged(tmp_path):
    text = FRIC_LIST.replace("      INCLUDE", "      USE SIZES\n      INCLUDE")
    module = "      MODULE SIZES\n      INTEGER NTWO\n      END MODULE\n"
    about = _fric(tmp_path, "      DIMENSION DROT(NTWO,2)", "LM = INT(DROT(1,1))", module + text)
    assert about.routine is not None
    assert found("signature.dimensions", about) == []


def test_dimensions_of_what_is_not_used_do_not_matter(tmp_path):
    about = _fric(tmp_path, "      DIMENSION PREDEF(NPRED,2)")
    assert found("signature.dimensions", about) == []


@pytest.mark.parametrize(("length", "faults"), [("80", 0), ("8", 0), ("(*)", 0), ("120", 1)])
def test_lengths_of_names(tmp_path, length, faults):
    about = _fric(tmp_path, f"      CHARACTER*{length} CINAME", "IF (CINAME(1:1).EQ.'A') LM = 2")
    findings = found("signature.names", about)
    assert len(findings) == faults
    if findings:
        assert "120 characters, but the host passes 80" in findings[0].detail
        assert findings[0].where == "law.f:7"


def test_known_names_in_other_places(tmp_path):
    text = FRIC_LIST.replace("NPT,NODE", "NODE,NPT")
    (finding,) = found("signature.order", _fric(tmp_path, "", "LM = NODE", text))
    assert finding.detail == (
        "argument 25 of FRIC is called 'node', which is the name of argument 26; "
        "the host passes NPT there"
    )


def test_names_of_ones_own_are_no_fault(tmp_path):
    text = FRIC_LIST.replace("NPT,NODE", "NPOINT,NKNOT").replace("SFD", "SPD")
    assert found("signature.order", _fric(tmp_path, "", "LM = NKNOT", text)) == []


def test_an_undeclared_array_is_taken_for_a_function(tmp_path):
    about = _fric(tmp_path, "      DIMENSION TAU(NFDIR)", "TAU(1) = PROPS(1)")
    findings = found("signature.types", about)
    assert any("'props'" in f.detail for f in findings)


def test_python_files_report_what_the_decorator_refused(tmp_path):
    path = written(
        tmp_path / "law.py",
        "import usersub\n@usersub.fric\ndef law(TAU, FORCE):\n    TAU[0] = FORCE\n",
    )
    (finding,) = found("signature.names", subject(path, "fric"))
    assert "FORCE" in finding.detail


# Symbols.


def test_a_file_that_does_not_compile(tmp_path):
    about = subject(_FIELD / "planted" / "compile_error.f", "fric")
    (finding,) = found("symbols.entry", about)
    assert finding.where == "compile_error.f:2"
    with pytest.raises(CannotCheck, match=r"see symbols\.entry"):
        found("symbols.undefined", about)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("law.c", "void fric(int *lm) { *lm = 0; }\n", "it has 'fric'"),
        ("law.cpp", "void fric(int *lm) { *lm = 0; }\n", "it has '_Z4fricPi'"),
        (
            "law.f90",
            "module own\ncontains\nsubroutine fric(lm)\ninteger lm\nlm = 0\n"
            "end subroutine\nend module\n",
            "inside of MODULE OWN",
        ),
    ],
)
def test_an_entry_under_another_name(tmp_path, name, text, said):
    (finding,) = found("symbols.entry", subject(written(tmp_path / name, text), "fric"))
    assert said in finding.detail


def test_a_name_that_nobody_defines():
    about = subject(_FIELD / "planted" / "missing_symbol.f")
    (finding,) = found("symbols.undefined", about)
    assert "needs KELSEWHERE" in finding.detail
    assert finding.where == "missing_symbol.f:8"


def test_whole_routines_pass(tmp_path):
    for path in (in_c(tmp_path), in_fortran(tmp_path)):
        for rule in (*(f"signature.{r}" for r in _RULES), "symbols.entry", "symbols.undefined"):
            assert _ignored(rule, subject(path)) == [], rule


def test_the_helpers_make_what_they_say(tmp_path):
    assert check_routines.subject(in_c(tmp_path)).interface.name == "vfric_coef"
