# SPDX-License-Identifier: MIT
"""Branches by names and by step: found in the source, looked at, told with the finding."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from check_routines import written

from usersub.check import Case, Step, check, reproduce
from usersub.check.rule import FAIL, PASS
from usersub.check.subject import Around, Subject
from usersub.check.subjects import around
from usersub.check.words import around_in_words, case_in_words

pytestmark = pytest.mark.usefixtures("fortran")

_HEAD = """\
      SUBROUTINE VFRIC_COEF(FCOEF,FCOEFDERIV,NBLOCK,NPROPS,NTEMP,
     1 NFIELDS,JFLAGS,RDATA,SURFINT,SURFSLV,SURFMST,PROPS,SLIPRATE,
     2 PRESSURE,TEMPAVG,FIELDAVG)
      INCLUDE 'VABA_PARAM.INC'
      DIMENSION FCOEF(NBLOCK),JFLAGS(2),PROPS(NPROPS),SLIPRATE(NBLOCK)
      CHARACTER*80 SURFINT,SURFSLV,SURFMST
"""
_TAIL = """\
      DO K=1,NBLOCK
        FCOEF(K)=XMU
      END DO
      END
"""


def _file(folder: Path, body: str) -> Path:
    return written(folder / "law.for", f"{_HEAD}{body}{_TAIL}")


def _subject(path: Path, **changes: object) -> Subject:
    from usersub.check.subjects.targets import subjects, wishes

    return next(iter(subjects(path, wishes(props=(), temperatures=False)))).but(**changes)


def _one(path: Path, rule: str):
    (report,) = check(path, rules=[rule])
    (result,) = report.results
    return report, result


def test_a_fault_behind_a_name_is_found_and_reproduced(tmp_path, capsys):
    path = _file(tmp_path, "      XMU=0.3D0\n      IF (SURFSLV.EQ.'BELT') XMU=-0.3D0\n")
    report, result = _one(path, "bound.coefficient")
    assert result.verdict == FAIL
    assert result.detail.startswith("with secondary surface 'BELT': ")
    assert "secondary surface 'BELT'" in result.words
    assert "names=('CHECKED', 'BELT', '')" in result.reproduction
    assert ("names, steps", "interaction 'CHECKED' in step 1; secondary surface 'BELT'") in [
        (v.name, v.value) for v in report.head.values
    ]
    again = reproduce(
        path, result.rule, result.case, interface="vfric_coef", props=(), temperatures=False
    )
    assert again is not None and again.detail == result.detail
    assert "'BELT'" in capsys.readouterr().out


@pytest.mark.parametrize("condition", ["JFLAGS(1).EQ.3", "JFLAGS(1) .GT. 1"])
def test_a_fault_in_a_later_step_is_found(tmp_path, condition):
    path = _file(tmp_path, f"      XMU=0.3D0\n      IF ({condition}) XMU=-0.3D0\n")
    # In one increment no step follows another.
    subject = _subject(path)
    (place,) = around.others(subject)
    assert place.step_numbers[0] == 1 and place.step_numbers[1] > 1


def test_friction_under_one_name_alone_is_what_is_checked(tmp_path):
    path = _file(tmp_path, "      XMU=0.D0\n      IF (SURFINT.EQ.'PADS') XMU=PROPS(1)\n")
    report, result = _one(path, "friction.present")
    assert result.verdict == PASS
    assert report.subject.around == Around(("PADS", "", ""))
    assert len(report.subject.props) == 1


def test_a_name_that_is_refused_is_no_fault(tmp_path):
    body = (
        "      XMU=0.3D0\n      IF (SURFINT.EQ.'PADS') THEN\n        XMU=0.2D0\n"
        "      ELSE IF (SURFINT.NE.'DISC') THEN\n        CALL XPLB_EXIT\n      END IF\n"
    )
    report, result = _one(_file(tmp_path, body), "process.stop")
    assert result.verdict == PASS
    places = (report.subject.around, *report.subject.others)
    assert {place.names[0] for place in places} == {"PADS", "DISC"}


def test_names_that_change_nothing_are_not_looked_at(tmp_path):
    path = _file(tmp_path, "      XMU=0.3D0\n      IF (SURFINT.EQ.'PADS') XMU=0.3D0\n")
    assert around.others(_subject(path)) == ()


def test_constants_are_read_from_code_alone(tmp_path):
    body = "C     'NO'\n      XMU=0.3D0\n      IF (SURFINT.EQ.'YES ') XMU=0.2D0 ! 'NEITHER'\n"
    found = around.constants(_subject(_file(tmp_path, body)))
    assert found[0] == "YES" and "NO" not in found


def test_places_in_words():
    assert around_in_words(("CHECKED", "", ""), (1, 1)) == []
    assert around_in_words(("X", "", "Y"), (2, 2)) == [
        "interaction 'X'",
        "main surface 'Y'",
        "step 2",
    ]
    case = Case((Step(((0.0,),), (1.0,)),), names=("X", "", ""), step_numbers=(1, 2))
    assert "interaction 'X', step 2 from the second increment on" in case_in_words(case)
    assert Case.from_json(case.as_json()) == case


def test_a_subject_places_its_cases(tmp_path):
    subject = _subject(_file(tmp_path, "      XMU=0.3D0\n"), around=Around(("X", "", ""), (1, 1)))
    case = Case((Step(((0.0,),), (1.0,)),))
    placed = subject.placed(case)
    assert placed == replace(case, names=("X", "", ""), step_numbers=(1, 1))
    assert subject.but(around=Around()).at(placed).around == subject.around
