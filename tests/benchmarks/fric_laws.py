# SPDX-License-Identifier: MIT
"""Coulomb friction with elastic slip behind FRIC in three languages, and as a loop by hand."""

from __future__ import annotations

import math

from usersub import abi

#: Coefficient, elastic slip.
PROPS = (0.3, 1e-3)

_BODY = """\
  const double mu = {props}[0], reach = {props}[1], p = {p};
  const double x = {state}[0] + {slip}[0], y = {state}[1] + {slip}[1];
  const double length = sqrt(x * x + y * y), strength = mu * p;
  const int slips = length > reach;
  const double d = slips ? length : reach, u = x / d, v = y / d;
  const double stiff = strength / d, along = slips ? -stiff : 0;
  const double plastic = slips ? length - reach : 0;
  {tau}[0] = strength * u, {tau}[1] = strength * v;
  {dg}[0] = stiff + along * u * u, {dg}[1] = {dg}[2] = along * u * v;
  {dg}[3] = stiff + along * v * v;
  {dp}[0] = mu * u, {dp}[1] = mu * v;
  {dslip}[0] = plastic * u, {dslip}[1] = plastic * v;
  {state}[0] = reach * u, {state}[1] = reach * v;
  {sed}[0] = 0.5 * strength * reach * (u * u + v * v);
  {sfd}[0] = strength * plastic;
"""

C_ROUTINE = (
    "#include <math.h>\n#include <usersub/abi.h>\nvoid fric_(USUB_FRIC_PARAMETERS) {\n"
    "  if (*LM == 2) {\n    STATEV[0] = STATEV[1] = 0;\n    return;\n  }\n  *LM = 0;\n"
    + _BODY.format(
        props="PROPS", p="*PRESS", state="STATEV", slip="DGAM", tau="TAU", dg="DDTDDG",
        dp="DDTDDP", dslip="DSLIP", sed="SED", sfd="SFD",
    )
    + "}\n"
)  # fmt: skip

C_LIMIT = (
    """\
#include <math.h>
#include <string.h>
typedef struct { int *lm; double *tau, *dg, *dp, *dslip, *sed, *sfd, *state; const double *start,
  *slip, *p, *props; } arrays;
__attribute__((noinline)) static void limit(const arrays *a, long n) {
  int *restrict lm = a->lm;
  double *restrict tau = a->tau, *restrict dg = a->dg, *restrict dp = a->dp,
         *restrict dslip = a->dslip, *restrict sed = a->sed, *restrict sfd = a->sfd,
         *restrict state = a->state;
  for (long i = 0; i < n; ++i) {
    if (!(a->p[i] > 0)) {
      lm[i] = 2;
      memset(tau + 2 * i, 0, 16), memset(dg + 4 * i, 0, 32), memset(dp + 2 * i, 0, 16);
      memset(dslip + 2 * i, 0, 16), memcpy(state + 2 * i, a->start + 2 * i, 16);
      sed[i] = sfd[i] = 0;
      continue;
    }
    lm[i] = 0;
    double *s = state + 2 * i;
    s[0] = a->start[2 * i], s[1] = a->start[2 * i + 1];
"""
    + _BODY.format(
        props="a->props", p="a->p[i]", state="s", slip="(a->slip + 2 * i)", tau="(tau + 2 * i)",
        dg="(dg + 4 * i)", dp="(dp + 2 * i)", dslip="(dslip + 2 * i)", sed="(sed + i)",
        sfd="(sfd + i)",
    )
    + """\
  }
}
void repeat(const arrays *a, long n, long times) {
  for (long t = 0; t < times; ++t) {
    limit(a, n);
    __asm__ volatile("" ::: "memory");
  }
}
"""
)  # fmt: skip


def law(LM, TAU, DDTDDG, DDTDDP, DSLIP, SED, SFD, STATEV, DGAM, PRESS, PROPS):
    """The same in Python."""
    if LM[0] == 2:
        STATEV[0] = STATEV[1] = 0.0
        return
    LM[0] = 0
    mu, reach = PROPS[0], PROPS[1]
    x, y = STATEV[0] + DGAM[0], STATEV[1] + DGAM[1]
    length = math.sqrt(x * x + y * y)
    strength = mu * PRESS
    slips = length > reach
    d = length if slips else reach
    u, v = x / d, y / d
    stiff = strength / d
    along = -stiff if slips else 0.0
    plastic = length - reach if slips else 0.0
    TAU[0] = strength * u
    TAU[1] = strength * v
    DDTDDG[0, 0] = stiff + along * u * u
    DDTDDG[0, 1] = DDTDDG[1, 0] = along * u * v
    DDTDDG[1, 1] = stiff + along * v * v
    DDTDDP[0] = mu * u
    DDTDDP[1] = mu * v
    DSLIP[0] = plastic * u
    DSLIP[1] = plastic * v
    STATEV[0] = reach * u
    STATEV[1] = reach * v
    SED[0] = 0.5 * strength * reach * (u * u + v * v)
    SFD[0] = strength * plastic


def fortran_routine() -> str:
    """The law in fixed form, with the argument list of the table."""
    names = [argument.name for argument in abi.interface("fric").args]
    lines = [", ".join(names[i : i + 4]) for i in range(0, len(names), 4)]
    return f"""\
      SUBROUTINE FRIC({f",{chr(10)}     *  ".join(lines)})
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CINAME, SECNAME, MAINNAME
      DIMENSION TAU(NFDIR), DDTDDG(NFDIR,NFDIR), DDTDDP(NFDIR),
     *  DSLIP(NFDIR), STATEV(*), DGAM(NFDIR), PROPS(*)
      IF (LM .EQ. 2) THEN
        STATEV(1) = 0
        STATEV(2) = 0
        RETURN
      END IF
      LM = 0
      X = STATEV(1) + DGAM(1)
      Y = STATEV(2) + DGAM(2)
      ALEN = SQRT(X*X + Y*Y)
      STREN = PROPS(1)*PRESS
      D = PROPS(2)
      ALONG = 0
      PLAS = 0
      IF (ALEN .GT. PROPS(2)) THEN
        D = ALEN
        ALONG = -STREN/D
        PLAS = ALEN - PROPS(2)
      END IF
      U = X/D
      V = Y/D
      STIFF = STREN/D
      TAU(1) = STREN*U
      TAU(2) = STREN*V
      DDTDDG(1,1) = STIFF + ALONG*U*U
      DDTDDG(1,2) = ALONG*U*V
      DDTDDG(2,1) = ALONG*U*V
      DDTDDG(2,2) = STIFF + ALONG*V*V
      DDTDDP(1) = PROPS(1)*U
      DDTDDP(2) = PROPS(1)*V
      DSLIP(1) = PLAS*U
      DSLIP(2) = PLAS*V
      STATEV(1) = PROPS(2)*U
      STATEV(2) = PROPS(2)*V
      SED = 0.5*STREN*PROPS(2)*(U*U + V*V)
      SFD = STREN*PLAS
      END
"""
