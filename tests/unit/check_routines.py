# SPDX-License-Identifier: MIT
"""Small routines behind VFRIC_COEF and FRIC, whole but for one place, and subjects made of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import usersub
from usersub import abi
from usersub.check.rule import RULES, Finding
from usersub.check.rules import all_rules
from usersub.check.subject import Scales, Subject
from usersub.errors import Error

_C = """\
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <omi_for_c.h>
{above}
void FOR_NAME(vfric_coef, VFRIC_COEF)(double *fCoef, double *fCoefDeriv, int *nBlock, int *nProps,
    int *nTemp, int *nFields, int *jFlags, double *rData, char *surfInt, char *surfSec,
    char *surfMain, double *props, double *slipRate, double *pressure, double *tempAvg,
    double *fieldAvg) {{
  {first}
  for (int k = 0; k < *nBlock; ++k) {{
    {body}
  }}
}}
"""

_FORTRAN = """\
      SUBROUTINE VFRIC_COEF(FCOEF,FCOEFD,NBLOCK,NPROPS,NTEMP,NFIELDS,
     1 JFLAGS,RDATA,SURFINT,SURFSLV,SURFMST,PROPS,SLIPRT,PRESS,TEMPAV,
     2 FIELDA)
      INCLUDE 'VABA_PARAM.INC'
      DIMENSION FCOEF(NBLOCK),PROPS(NPROPS),SLIPRT(NBLOCK),PRESS(NBLOCK)
      CHARACTER*80 SURFINT,SURFSLV,SURFMST
{above}
{first}
      DO K = 1, NBLOCK
{body}
      END DO
      END
"""
#: FRIC with a list and declarations of one's own.
FRIC_LIST = """\
      SUBROUTINE FRIC(LM,TAU,DDTDDG,DDTDDP,DSLIP,SED,SFD,
     1 DDTDDT,PNEWDT,STATEV,DGAM,TAULM,PRESS,DPRESS,DDPDDH,SLIP,
     2 KSTEP,KINC,TIME,DTIME,NOEL,CINAME,SLNAME,MSNAME,NPT,NODE,
     3 NPATCH,COORDS,RCOORD,DROT,TEMP,PREDEF,NFDIR,MCRD,NPRED,
     4 NSTATV,CHRLNGTH,PROPS,NPROPS)
      INCLUDE 'ABA_PARAM.INC'
"""
#: Properties: coefficient at rest, at infinite rate, decay.
PROPS = (0.3, 0.2, 5.0)
BODY_C = "fCoef[k] = props[1] + (props[0] - props[1]) * exp(-props[2] * slipRate[k]);"
BODY_FORTRAN = "FCOEF(K) = PROPS(2)+(PROPS(1)-PROPS(2))*EXP(-PROPS(3)*SLIPRT(K))"


def in_c(folder: Path, body: str = BODY_C, first: str = "", above: str = "") -> Path:
    """A C file: statements of one point, those before the loop, what stands above."""
    path = folder / "law.c"
    path.write_text(_C.format(body=body, first=first, above=above), encoding="ascii")
    return path


def in_fortran(folder: Path, body: str = BODY_FORTRAN, first: str = "", above: str = "") -> Path:
    """The same in Fortran; lines are indented here."""

    def lines(text: str) -> str:
        return "\n".join("      " + line for line in text.splitlines()) or "C"

    return written(
        folder / "law.f",
        _FORTRAN.format(body=lines(body), first=lines(first), above=lines(above)),
    )


def written(path: Path, text: str) -> Path:
    """The path, after the text was written to it."""
    path.write_text(text, encoding="ascii")
    return path


def subject(path: Path, interface: str = "vfric_coef", **changes: Any) -> Subject:
    """A file as it comes to the rules, whether it can be loaded or not."""
    given: dict[str, Any] = {
        "props": PROPS, "temperatures": False, "scales": Scales(slip=0.05, load=2.0), "path": path,
    } | changes  # fmt: skip
    precision = given.get("precision", "double")
    try:
        file = usersub.load(path, precision=precision)
        routine = file[interface]
    except Error as error:
        face = abi.interface(interface, abi.LEGACY)
        return Subject(path.name, face, failure=error, **given)
    return Subject(path.name, routine.interface, routine=routine, file=file, **given)


def found(rule: str, about: Subject) -> list[Finding]:
    """What a rule finds; raises what the rule raises."""
    all_rules()
    return list(RULES[rule].look(about) or ())
