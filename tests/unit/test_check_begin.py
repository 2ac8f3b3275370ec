# SPDX-License-Identifier: MIT
"""What is there before the first contact: VEXTERNALDB of the file, and files that it reads."""

import pytest

import usersub
from usersub.check import check

pytestmark = pytest.mark.usefixtures("fortran")

_ROUTINE = """
      SUBROUTINE VFRIC_COEF(FCOEF,FDERIV,NBLOCK,NPROPS,NTEMP,NFIELDS,
     1 JFLAGS,RDATA,SINT,SSLV,SMST,PROPS,SLIPRATE,PRESSURE,TAVG,FAVG)
      INCLUDE 'VABA_PARAM.INC'
      DIMENSION FCOEF(NBLOCK)
      COMMON /KTAB/ XMU(3), NMU
      DO K = 1, NBLOCK
        FCOEF(K) = XMU(NMU)
      END DO
      END
      SUBROUTINE VEXTERNALDB(LOP,IARR,NI,RARR,NR)
      INCLUDE 'VABA_PARAM.INC'
      COMMON /KTAB/ XMU(3), NMU
      IF (LOP .EQ. 0) THEN
BODY
      END IF
      END
"""
_CONSTANTS = """
        NMU = 1
        XMU(1) = 0.3D0"""
_FILE = """
        OPEN(UNIT=105,FILE='mu.dat',STATUS='OLD')
        READ(105,*) NMU, (XMU(I), I=1,NMU)
        CLOSE(105)"""


def _report(folder, body, rules=("bound", "friction", "memory.stack", "data.shared")):
    path = folder / "routine.for"
    path.write_text(_ROUTINE.replace("BODY", body.strip("\n")))
    (report,) = check(path, rules=rules, jobs=1, seconds=600)
    return report


def _value(report, name):
    return next((v.value for v in report.head.values if v.name == name), "")


def test_what_the_start_of_the_analysis_prepares_is_there(tmp_path):
    report = _report(tmp_path, _CONSTANTS)
    assert report.failures == (), str(report)
    assert "VEXTERNALDB of the file was called with LOP = 0" in _value(report, "before contact")


def test_a_file_beside_the_source_is_found(tmp_path, monkeypatch):
    (tmp_path / "mu.dat").write_text("2 0.1 0.4\n")
    monkeypatch.chdir("/")
    report = _report(tmp_path, _FILE)
    assert report.failures == (), str(report)
    assert _value(report, "files") == "mu.dat"


def test_an_entry_that_ends_the_process_is_left_out(tmp_path):
    report = _report(tmp_path, _FILE, rules=("signature", "friction"))
    words = _value(report, "before contact")
    assert "left out" in words
    assert "mu.dat" in words


def test_a_table_that_the_routine_changes_as_well_is_shared(tmp_path):
    path = tmp_path / "routine.for"
    changed = _ROUTINE.replace("BODY", _CONSTANTS.strip("\n"))
    path.write_text(
        changed.replace("FCOEF(K) = XMU(NMU)", "XMU(2) = 0.3D0\n        FCOEF(K) = XMU(2)")
    )
    (report,) = check(path, rules=["data.shared"], jobs=1, seconds=600)
    assert [f.rule for f in report.failures] == ["data.shared"]


def test_nothing_is_called_where_routines_are_loaded_otherwise(tmp_path):
    _report(tmp_path, _CONSTANTS, rules=("friction",))
    file = usersub.load(tmp_path / "routine.for")
    file["vfric_coef"].entry("double")
    from usersub.routine import library

    assert library.after_open is None


def test_traffic_is_counted_where_the_files_are(tmp_path):
    (tmp_path / "mu.dat").write_text("0.4\n")
    body = "OPEN(UNIT=105,FILE='mu.dat',STATUS='OLD')\nREAD(105,*) XMU(1)\nCLOSE(105)\n"
    text = _ROUTINE.replace("BODY", "        NMU = 1").replace(
        "      DO K", "".join(f"      {line}\n" for line in body.splitlines()) + "      DO K"
    )
    (tmp_path / "routine.for").write_text(text)
    (report,) = check(tmp_path / "routine.for", rules=["process.output"], jobs=1, seconds=600)
    assert [f.rule for f in report.failures] == ["process.output"], str(report)
