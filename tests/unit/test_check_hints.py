# SPDX-License-Identifier: MIT
"""What a reader of the report is told to change, and what is no fault, in routines as people write
them."""

from __future__ import annotations

from pathlib import Path

import pytest
from check_routines import FRIC_LIST, in_c, in_fortran, subject, written
from check_routines import found as findings

from usersub.check import check
from usersub.check.rule import NOT_APPLICABLE, PASS, Finding
from usersub.check.rules import indices, repeat

pytestmark = pytest.mark.usefixtures("fortran")

_FRIC = (
    FRIC_LIST
    + """\
      CHARACTER*80 CINAME,SLNAME,MSNAME
      DIMENSION TAU(NFDIR),DDTDDG(NFDIR,NFDIR),DDTDDP(NFDIR),
     1 DSLIP(NFDIR),DGAM(NFDIR),TR(2)
{first}
      IF (LM.EQ.2) RETURN
      LM=0
      XK=1.D3
      T=0.D0
      DO I=1,NFDIR
        TR(I)=TAU(I)+XK*DGAM(I)
        T=T+TR(I)**2
      END DO
      T=SQRT(T)
      TC=XMU*MAX(PRESS,0.D0)
      F=1.D0
      IF (T.GT.TC) F=TC/T
      DO I=1,NFDIR
        DSLIP(I)=(1.D0-F)*TR(I)/XK
        TAU(I)=F*TR(I)
{pressure}
        IF (F.LT.1.D0) DDTDDP(I)=XMU*TR(I)/T
        DO J=1,NFDIR
          DDTDDG(I,J)=0.D0
          IF (F.LT.1.D0) DDTDDG(I,J)=-XK*F*TR(I)*TR(J)/T**2
        END DO
        DDTDDG(I,I)=DDTDDG(I,I)+XK*F
      END DO
      END
"""
)
_EXPLICIT = """\
      subroutine {name}
      include 'vaba_param.inc'
      character*80 surfInt, surfSlv, surfMst
      dimension {arrays}
      do i = 1, {n}
        {body}
      end do
      end
"""
_VFRIC = """vfric(fTangential, statev, kStep, kInc, nContact, nFacNod,
     1 nSlvNod, nMstNod, nFricDir, nDir, nStateVar, nProps, nTemp,
     2 nPred, numDefTfv, jSlvUid, jMstUid, jConSlvid, jConMstid,
     3 timStep, timGlb, dTimCur, surfInt, surfSlv, surfMst, lContType,
     4 dSlipFric, fStickForce, fTangPrev, fNormal, frictionWork,
     5 shape, coordSlv, coordMst, dirCosSl, dircosN, props, areaSlv,
     6 tempSlv, preDefSlv, tempMst, preDefMst)"""


def _fric(folder: Path, first: str, pressure: str = "        DDTDDP(I)=0.D0") -> Path:
    return written(folder / "law.for", _FRIC.format(first=first, pressure=pressure))


def _vfric(folder: Path, body: str) -> Path:
    arrays = (
        "fTangential(nFricDir,nContact), fNormal(nContact),\n"
        "     1 fStickForce(nContact), dSlipFric(nDir,nContact),\n"
        "     2 dirCosSl(nDir,nContact), statev(nStateVar,nSlvNod),\n"
        "     3 jSlvUid(nSlvNod), jConSlvid(nContact)"
    )
    text = _EXPLICIT.format(name=_VFRIC, arrays=arrays, n="nContact", body=body)
    return written(folder / "law.for", text)


def _result(path: Path, rule: str, **given: object):
    (report,) = check(path, rules=[rule], **given)  # type: ignore[arg-type]
    return report.results[0]


# What is said of outputs.


def test_an_output_that_zero_is_added_to_is_left_not_unwritten(tmp_path):
    path = _fric(tmp_path, "      XMU=0.3D0", "        DDTDDP(I)=DDTDDP(I)+0.D0")
    result = _result(path, "outputs.written", props=())
    assert result.detail == "the routine left DDTDDP(1) as it was on entry although LM = 0"
    assert "whatever it holds on entry" in result.hint


def test_slip_of_the_last_iteration_is_named(tmp_path):
    first = "      XMU=0.3D0\n      IF (DSLIP(1).EQ.0.D0) XMU=0.36D0"
    result = _result(_fric(tmp_path, first), "history.iterations", props=())
    assert "DSLIP and LM hold on entry what the routine returned" in result.hint


# Where a local variable is chance.


def test_an_unset_local_is_no_kept_data(tmp_path):
    first = "      IF (KINC.GT.1) XMU=0.3D0*DTIME"
    about = subject(_fric(tmp_path, first), "fric")
    # Whether it shows is a matter of what lies in a register.
    found = repeat._explained(about, Finding("differs", hint=repeat.HINT))
    assert found is not None and "SAVE" not in found.hint
    assert "the compiler names xmu" in found.hint and found.where.startswith("law.for:")
    kept = subject(_fric(tmp_path, "      SAVE XMU\n      XMU=XMU+0.3D0"), "fric")
    assert repeat._explained(kept, Finding("differs", hint=repeat.HINT)).hint == repeat.HINT


# Constants in COMMON.

_BLOCK = "      COMMON /FRDAT/ XMU,XNONE\n"
_BLOCK_DATA = f"      BLOCK DATA\n      INCLUDE 'ABA_PARAM.INC'\n{_BLOCK}"
_DATA = "      DATA XMU,XNONE /0.3D0,1.D0/\n      END\n"


def _common(folder: Path, more: str = "", other: str = "") -> Path:
    path = _fric(folder, _BLOCK.rstrip() + more)
    return written(path, path.read_text(encoding="ascii") + _BLOCK_DATA + _DATA + other)


def test_constants_of_block_data_are_no_state(tmp_path):
    assert findings("data.shared", subject(_common(tmp_path), "fric")) == []


@pytest.mark.parametrize(
    "more",
    [
        "\n      XNONE=2.D0",
        "\n      IF (PRESS.GT.9.D0) XNONE = PRESS",
        "\n      CALL OTHER(XNONE)",
        "\n      READ(15,*) XNONE",
    ],
)
def test_a_block_that_is_changed_is_state(tmp_path, more):
    other = "      SUBROUTINE OTHER(X)\n      REAL*8 X\n      X=X+1\n      END\n"
    path = _common(tmp_path, more, other)
    (finding,) = findings("data.shared", subject(path, "fric"))
    assert "COMMON /FRDAT/" in finding.detail


def test_a_block_that_another_unit_changes_is_state(tmp_path):
    other = f"      SUBROUTINE OTHER\n      REAL*8 A,B\n{_BLOCK.replace('XMU,XNONE', 'A,B')}"
    path = _common(tmp_path, "", other + "      B=A\n      END\n")
    assert findings("data.shared", subject(path, "fric"))


# Integers.


def test_a_coefficient_that_is_cut_is_found_without_properties(tmp_path):
    path = in_fortran(tmp_path, "FCOEF(K) = MU", first="MU = PROPS(1)")
    result = _result(path, "precision.digits")
    assert result.detail.startswith("MU is an integer, as its name begins with M")
    assert "with the properties 1.37" in result.detail
    assert "props=(1.37,)" in result.reproduction


def test_a_switch_is_no_coefficient(tmp_path):
    body = "FCOEF(K) = 0.1D0\nIF (MODE.EQ.1) FCOEF(K) = 0.3D0*PROPS(2)"
    path = in_fortran(tmp_path, body, first="MODE = PROPS(1)")
    assert _result(path, "precision.digits").verdict == PASS


# Directions and indices.


def test_an_anisotropic_law_of_the_model_is_no_fault(tmp_path):
    path = _vfric(
        tmp_path,
        "c = dirCosSl(1,i)**2\n        xmu = 0.3d0*c+0.15d0*(1.d0-c)\n"
        "        fTangential(1,i) = -min(xmu*fNormal(i),fStickForce(i))",
    )
    result = _result(path, "frame.rotation", props=())
    assert result.verdict == NOT_APPLICABLE and "anisotropic" in result.detail


def test_a_component_for_the_whole_is_a_fault(tmp_path):
    path = _vfric(
        tmp_path,
        "xmu = 0.3d0*abs(dirCosSl(1,i))\n"
        "        fTangential(1,i) = -min(xmu*fNormal(i),fStickForce(i))",
    )
    assert "one component after the other" in _result(path, "frame.rotation", props=()).hint


def test_a_global_number_as_index_is_told(tmp_path):
    path = _vfric(
        tmp_path,
        "n = jSlvUid(jConSlvid(i))\n        statev(1,n) = statev(1,n)+1.d0\n"
        "        fTangential(1,i) = -min(0.3d0*fNormal(i),fStickForce(i))",
    )
    hint = _result(path, "memory.state", props=(), states=1).hint
    assert "it is statev(nStateVar,nSecNod)" in hint
    assert "is jConSecid(i)" in hint and "is no such node but a global number" in hint


def test_points_that_depend_on_each_other_are_told_the_dimensions(tmp_path):
    path = in_c(tmp_path, "fCoef[k] = 0.3 + (k ? slipRate[k - 1] : 0);")
    (finding,) = findings("blocks.split", subject(path))
    assert "fieldAvg(nBlock,nFields)" in finding.hint


def test_dimensions_in_words(tmp_path):
    face = subject(_vfric(tmp_path, "x = 0"), "vfric").interface
    assert indices.declared(face, "dSlipFric") == "dSlipFric(nDir,nContact)"
    assert indices.declared(face, "statev") == "statev(nStateVar,nSecNod)"


# Output.


def test_what_is_written_in_the_first_increment_is_not_in_every_call(tmp_path):
    path = _vfric(
        tmp_path,
        "if (kInc.eq.1) write(6,*) 'called',kInc\n"
        "        fTangential(1,i) = -min(0.3d0*fNormal(i),fStickForce(i))",
    )
    assert _result(path, "process.output", props=()).verdict == PASS
