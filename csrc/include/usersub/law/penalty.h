/* SPDX-License-Identifier: MIT */
/** @file law/penalty.h
 * FRIC of an isotropic coefficient or of a strength (part of their headers): penalty enforcement
 * with an elastic slip.
 *
 * The elastic predictor is the elastic slip at the start of the increment plus the motion; up to
 * the allowable elastic slip, .005 of CHRLNGTH, the point sticks with the stiffness
 * strength/allowable, beyond it the rest is slip, along the predictor. The derivatives are those of
 * this update; that by a pressure of zero is the one from above, below there is none.
 *
 * State variables: elastic slip (NFDIR), then those of the law. The elastic slip cannot be
 * recovered from TAU, since the stiffness of the last increment belongs to its own pressure,
 * temperature and slip rate. In the increment that closes the point (LM = 2 on entry) there is no
 * friction, and all state variables are zero.
 */
#ifndef USERSUB_LAW_PENALTY_H
#define USERSUB_LAW_PENALTY_H

#include "point.h"

#include "begin.h"

/* Strength of a point and its derivative by pressure, from what the law says. A strength need not
 * look at the pressure. */
#ifdef USUB_LAW_GIVES_STRESS
#define USUB_STRENGTH(law, pressure) (law)
#define USUB_STRENGTH_BY_PRESSURE(law, pressure, by_pressure) (by_pressure)
#define USUB_NORMAL(expression) USUB_PRESSURE(expression)
#else
#define USUB_STRENGTH(law, pressure) ((law) * (pressure))
#define USUB_STRENGTH_BY_PRESSURE(law, pressure, by_pressure) ((law) + (pressure) * (by_pressure))
#define USUB_NORMAL(expression) (expression)
#endif

void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  const double allowable = 0.005 * *CHRLNGTH, p = USUB_NORMAL(*PRESS > 0 ? *PRESS : 0);
  USUB_FIELDS_ROOM;
  if (*LM == 2) {
    usub_clear(STATEV, *NSTATV);
    return;
  }
  if (!USUB_STANDARD_PROPS("FRIC", PROPS, *NPROPS) ||
      !USUB_ELASTIC_NEEDS(n, PROPS, *NPROPS, *NSTATV, allowable))
    return;
  *LM = 0;

  double elastic[2], direction[2] = {0, 0}, law, derivative[1][4] = {{0}};
  usub_rotate(n, DROT, STATEV, elastic);
  for (int a = 0; a < n; ++a)
    elastic[a] += DGAM[a];
  /* An elastic slip that was left at its limit is rounded: at rest it must not slip again. */
  const double length = usub_length(n, elastic);
  const int slips = length > allowable * (1 + 4 * 2.220446049250313e-16);
  const double plastic = slips ? length - allowable : 0;

  /* stress = strength * direction, the direction being shorter than one in stick */
  const double reach = fmax(length, allowable);
  usub_ask(USUB_RATE(usub_ratio(plastic, *DTIME)), USUB_PRESSURE(p),
           USUB_TEMPERATURE(0.5 * (TEMP[0] + TEMP[1])),
           USUB_FIELDS(usub_mean_fields(usub_fields_room, *NPRED, PREDEF, 2, PREDEF + 1, 2)),
           USUB_SLIP(plastic), USUB_TIME(*DTIME), USUB_STATE(STATEV + n), PROPS, *NPROPS, &law,
           derivative);
  const double strength = USUB_STRENGTH(law, p), secant = strength / reach;
  if (!USUB_STANDARD_NEEDS(law >= 0, USUB_NEGATIVE_TEXT, 0, 0) ||
      !USUB_STANDARD_NEEDS(strength - strength == 0, USUB_OVERFLOW_TEXT, 0, 0))
    return;
  const double by_pressure =
      USUB_NORMAL(*PRESS >= 0 ? USUB_STRENGTH_BY_PRESSURE(law, p, derivative[0][1]) : 0);
  const double by_slip = USUB_RATE(usub_ratio(derivative[0][0], *DTIME)) + derivative[0][3];
  const double along = slips ? USUB_STRENGTH(by_slip, p) - secant : 0;
  for (int a = 0; a < n; ++a)
    direction[a] = elastic[a] / reach;

  *SED = *SFD = 0;
  for (int a = 0; a < n; ++a) {
    TAU[a] = strength * direction[a];
    DSLIP[a] = plastic * direction[a];
    STATEV[a] = slips ? allowable * direction[a] : elastic[a];
    DDTDDP[a] = by_pressure * direction[a];
    DDTDDT[a] = DDTDDT[a + n] = 0.5 * USUB_STRENGTH(derivative[0][2], p) * direction[a];
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = (a == b ? secant : 0) + along * direction[a] * direction[b];
    *SED += 0.5 * TAU[a] * STATEV[a];
    *SFD += TAU[a] * DSLIP[a];
  }
}

#include "end.h"

#endif
