/* SPDX-License-Identifier: MIT */
/** @file coefficient_law.h
 * A friction coefficient behind all five interfaces; see `laws.h` for the form of a law's file.
 *
 * Behind FRIC the law does its own enforcement, by penalty: allowable elastic slip .005 of
 * CHRLNGTH, elastic slip in STATEV(1..NFDIR). It cannot be recovered from TAU, since the stiffness
 * of the last increment belongs to its own pressure, temperature and slip rate.
 */
#ifndef USERSUB_COEFFICIENT_LAW_H
#define USERSUB_COEFFICIENT_LAW_H

#include "laws.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Arguments never overlap; said of the parameters of a function of its own, it keeps the properties
 * in registers. */
static USUB_NOT_INLINED void
usub_coefficients(usub_real *USUB_RESTRICT coefficient, int points,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT rate,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT pressure,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT temperature,
                  const usub_real *USUB_RESTRICT props, int count) {
  for (int k = 0; k < points; ++k)
    coefficient[k] =
        usub_law(USUB_RATE(rate[k]), USUB_PRESSURE(pressure[k]),
                 USUB_TEMPERATURE(temperature ? temperature[k] : (usub_real)0), props, count, NULL);
}

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  if (!USUB_EXPLICIT_PROPS("VFRIC_COEF"))
    return;
  usub_coefficients(fCoef, *nBlock, USUB_RATE(slipRate), USUB_PRESSURE(pressure),
                    USUB_TEMPERATURE(*nTemp > 0 ? tempAvg : NULL), props, *nProps);
}

#ifndef USUB_SINGLE
void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const int n = *nBlock;
  if (!USUB_STANDARD_PROPS("FRIC_COEF", props, *nProps))
    return;
  for (int k = 0; k < n; ++k) {
    double derivative[3] = {0, 0, 0};
    fCoef[k] =
        usub_law(USUB_RATE(slipData[k]), USUB_PRESSURE(pressure[k]),
                 USUB_TEMPERATURE(*nTemp > 0 ? tempAvg[k] : 0.0), props, *nProps, derivative);
    for (int j = 0; j < 3; ++j)
      fCoefDeriv[k + (ptrdiff_t)n * j] = derivative[j];
  }
}

#define USUB_STATES_TEXT                                                                           \
  USUB_LAW " behind FRIC keeps its elastic slip in %I state variables, but the scene has %I"
#define USUB_LENGTH_TEXT USUB_LAW " behind FRIC needs a characteristic length above zero"

/* Penalty enforcement of the coefficient, isotropic: the elastic predictor is the elastic slip at
 * the start of the increment plus the motion; up to the allowable elastic slip the point sticks
 * with the stiffness strength/allowable, beyond it the rest is slip, along the predictor. The
 * derivatives are those of this update. */
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  const double allowable = 0.005 * *CHRLNGTH, p = *PRESS > 0 ? *PRESS : 0;
  if (*LM == 2) { /* open so far: no friction in the increment that closes the point */
    for (int a = 0; a < n && a < *NSTATV; ++a)
      STATEV[a] = 0;
    return;
  }
  if (!USUB_STANDARD_PROPS("FRIC", PROPS, *NPROPS) ||
      !USUB_STANDARD_NEEDS(*NSTATV >= n, USUB_STATES_TEXT, n, *NSTATV) ||
      !USUB_STANDARD_NEEDS(allowable > 0, USUB_LENGTH_TEXT, 0, 0))
    return;
  *LM = 0;

  double elastic[2] = {STATEV[0], 0}, direction[2] = {0, 0}, derivative[3] = {0, 0, 0};
  if (n > 1) {
    elastic[0] = DROT[0] * STATEV[0] + DROT[2] * STATEV[1];
    elastic[1] = DROT[1] * STATEV[0] + DROT[3] * STATEV[1];
  }
  for (int a = 0; a < n; ++a)
    elastic[a] += DGAM[a];
  const double length = usub_length(n, elastic), plastic = fmax(length - allowable, 0);
  const int slips = plastic > 0;

  /* stress = strength * direction, the direction being shorter than one in stick */
  const double reach = slips ? length : allowable;
  const double mu =
      usub_law(USUB_RATE(usub_ratio(plastic, *DTIME)), p,
               USUB_TEMPERATURE(0.5 * (TEMP[0] + TEMP[1])), PROPS, *NPROPS, derivative);
  const double strength = mu * p, secant = strength / reach;
  const double by_pressure = p > 0 ? mu + p * derivative[1] : 0;
  const double along = slips ? p * usub_ratio(derivative[0], *DTIME) - secant : 0;
  for (int a = 0; a < n; ++a)
    direction[a] = elastic[a] / reach;

  *SED = *SFD = 0;
  for (int a = 0; a < n; ++a) {
    TAU[a] = strength * direction[a];
    DSLIP[a] = plastic * direction[a];
    STATEV[a] = slips ? allowable * direction[a] : elastic[a];
    DDTDDP[a] = by_pressure * direction[a];
    DDTDDT[a] = DDTDDT[a + n] = 0.5 * p * derivative[2] * direction[a];
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = (a == b ? secant : 0) + along * direction[a] * direction[b];
    *SED += 0.5 * TAU[a] * STATEV[a];
    *SFD += TAU[a] * DSLIP[a];
  }
}
#endif

#ifdef __cplusplus
}
#endif

#endif
