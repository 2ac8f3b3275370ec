/* SPDX-License-Identifier: MIT */
/** @file traction_law.h
 * A shear traction as a function of the slip rate, behind FRIC, VFRIC and VFRICTION; see `laws.h`
 * for the form of a law's file. The coefficient interfaces cannot carry it.
 *
 * All motion is slip: there is no elastic part and no state. In explicit analyses the force is
 * traction times contact area, bounded by the stick force as everywhere.
 */
#ifndef USERSUB_TRACTION_LAW_H
#define USERSUB_TRACTION_LAW_H

#define USUB_LAW_GIVES_TRACTION
#include "laws.h"

#ifndef USUB_SINGLE
#ifdef __cplusplus
extern "C" {
#endif

/* Backward Euler: the traction belongs to the mean slip rate of the increment. */
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  double derivative[3] = {0, 0, 0};
  if (*LM == 2)
    return; /* open so far: no friction in the increment that closes the point */
  if (!USUB_STANDARD_PROPS("FRIC", PROPS, *NPROPS) ||
      !USUB_STANDARD_NEEDS(*DTIME > 0, USUB_LAW " behind FRIC needs a time increment", 0, 0))
    return;
  *LM = 0;

  const double length = usub_length(n, DGAM);
  const double traction =
      usub_law(USUB_RATE(length / *DTIME), USUB_PRESSURE(*PRESS),
               USUB_TEMPERATURE(0.5 * (TEMP[0] + TEMP[1])), PROPS, *NPROPS, derivative);
  const double tangent = derivative[0] / *DTIME;
  const double secant = length > 0 ? traction / length : tangent;
  *SFD = 0;
  for (int a = 0; a < n; ++a) {
    const double direction = length > 0 ? DGAM[a] / length : 0;
    TAU[a] = secant * DGAM[a];
    DSLIP[a] = DGAM[a];
    DDTDDP[a] = derivative[1] * direction;
    DDTDDT[a] = DDTDDT[a + n] = 0.5 * derivative[2] * direction;
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = (a == b ? secant : 0) +
                          (length > 0 ? (tangent - secant) * direction * (DGAM[b] / length) : 0);
    *SFD += TAU[a] * DSLIP[a];
  }
}

#ifdef __cplusplus
}
#endif
#endif

#endif
