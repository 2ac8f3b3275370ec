/* SPDX-License-Identifier: MIT */
/** @file traction_law.h
 * A shear traction as a function of the slip rate, behind FRIC, VFRIC and VFRICTION; see `laws.h`
 * for the form of a law's file. The coefficient interfaces cannot carry it.
 *
 * All motion is slip: there is no elastic part, and no state but the law's own. In explicit
 * analyses the force is traction times contact area, bounded by the stick force as everywhere.
 */
#ifndef USERSUB_TRACTION_LAW_H
#define USERSUB_TRACTION_LAW_H

#define USUB_LAW_GIVES_STRESS
#include "law/point.h"

#ifndef USUB_DUAL_PASS
#include "law/explicit.h"

#ifndef USUB_SINGLE
#include "law/begin.h"

/* Backward Euler: the traction belongs to the mean slip rate of the increment. */
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  double traction, derivative[1][4] = {{0}};
  USUB_FIELDS_ROOM;
  if (*LM == 2) { /* open so far: no friction in the increment that closes the point */
#ifndef USUB_LAW_FORGETS
    usub_clear(STATEV, *NSTATV);
#endif
    return;
  }
  if (!USUB_STANDARD_PROPS("FRIC", PROPS, *NPROPS) ||
      !USUB_STATES_NEEDED(STANDARD, USUB_STATES_TEXT("FRIC"), PROPS, *NPROPS,
                          usub_scalars(PROPS, *NPROPS), *NSTATV) ||
      !USUB_STANDARD_NEEDS(*DTIME > 0, USUB_TIME_TEXT, 0, 0))
    return;
  *LM = 0;

  const double length = usub_length(n, DGAM);
  usub_ask(USUB_RATE(length / *DTIME), USUB_PRESSURE(*PRESS > 0 ? *PRESS : 0),
           USUB_TEMPERATURE(0.5 * (TEMP[0] + TEMP[1])),
           USUB_FIELDS(usub_mean_fields(usub_fields_room, *NPRED, PREDEF, 2, PREDEF + 1, 2)),
           USUB_SLIP(length), USUB_TIME(*DTIME), USUB_STATE(STATEV), PROPS, *NPROPS, &traction,
           derivative);
  const double by_pressure = USUB_PRESSURE(*PRESS >= 0 ? derivative[0][1] : 0);
  const double tangent = derivative[0][0] / *DTIME + derivative[0][3];
  const double secant = length > 0 ? traction / length : tangent;
  *SFD = 0;
  for (int a = 0; a < n; ++a) {
    const double direction = length > 0 ? DGAM[a] / length : 0;
    TAU[a] = secant * DGAM[a];
    DSLIP[a] = DGAM[a];
    DDTDDP[a] = by_pressure * direction;
    DDTDDT[a] = DDTDDT[a + n] = 0.5 * derivative[0][2] * direction;
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = (a == b ? secant : 0) +
                          (length > 0 ? (tangent - secant) * direction * (DGAM[b] / length) : 0);
    *SFD += TAU[a] * DSLIP[a];
  }
}

#include "law/end.h"
#endif
#endif

#endif
