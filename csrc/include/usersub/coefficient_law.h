/* SPDX-License-Identifier: MIT */
/** @file coefficient_law.h
 * A friction coefficient behind all five interfaces; see `laws.h` for the form of a law's file.
 *
 * With scalar state variables (USUB_LAW_STATES) there is no VFRIC_COEF, which has none; FRIC_COEF
 * has them behind rData(8). The slip of the increment, which the two do not tell, is slip rate
 * times time increment there; its derivative is the one by the equivalent slip.
 *
 * With USUB_LAW_ANISOTROPIC the law fills `mu[2]`; behind FRIC and FRIC_COEF only.
 *
 * Behind FRIC the law does its own enforcement, see `law/penalty.h`.
 */
#ifndef USERSUB_COEFFICIENT_LAW_H
#define USERSUB_COEFFICIENT_LAW_H

#include "law/point.h"

#ifndef USUB_DUAL_PASS
#ifdef USUB_LAW_ANISOTROPIC
#ifndef USUB_SINGLE
#include "law/anisotropic.h"
#endif
#else
#include "law/explicit.h"
#ifndef USUB_SINGLE
#include "law/penalty.h"
#endif
#endif

#include "law/begin.h"

#if defined(USUB_LAW_FORGETS) && !defined(USUB_LAW_ANISOTROPIC)
/* Arguments never overlap; said of the parameters of a function of its own, it keeps the properties
 * in registers. */
static USUB_NOT_INLINED void
usub_coefficients(usub_real *USUB_RESTRICT coefficient, int points,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT rate,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT pressure,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT temperature,
                  USUB_MAY_BE_UNUSED const usub_real *USUB_RESTRICT field,
                  USUB_MAY_BE_UNUSED int fields, USUB_MAY_BE_UNUSED usub_real time_increment,
                  const usub_real *USUB_RESTRICT props, int count) {
  USUB_FIELDS_ROOM;
  for (int k = 0; k < points; ++k)
    coefficient[k] = usub_law(USUB_RATE(rate[k]), USUB_PRESSURE(pressure[k] > 0 ? pressure[k] : 0),
                              USUB_TEMPERATURE(temperature ? temperature[k] : (usub_real)0),
                              USUB_FIELDS(usub_mean_fields(usub_fields_room, fields, field + k,
                                                           points, field + k, points)),
                              USUB_SLIP(rate[k] * time_increment), USUB_TIME(time_increment), NULL,
                              props, count, NULL);
}

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  if (!USUB_EXPLICIT_PROPS("VFRIC_COEF", props, *nProps))
    return;
  usub_coefficients(fCoef, *nBlock, USUB_RATE_OR_SLIP(slipRate), USUB_PRESSURE(pressure),
                    USUB_TEMPERATURE(*nTemp > 0 ? tempAvg : NULL), USUB_FIELDS(fieldAvg),
                    USUB_FIELDS(*nFields), USUB_TIME_OR_SLIP(rData[2]), props, *nProps);
}
#endif

#ifndef USUB_SINGLE
/* With one friction direction there is one coefficient. */
#ifdef USUB_LAW_ANISOTROPIC
#define USUB_COEFFICIENTS_OF(directions) ((directions) > 1 ? 2 : 1)
#else
#define USUB_COEFFICIENTS_OF(directions) 1
#endif

#define USUB_ONE_POINT_TEXT                                                                        \
  USUB_LAW " behind FRIC_COEF keeps %I state variables, which belong to one point a call, not %I"

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const int n = *nBlock;
  USUB_FIELDS_ROOM;
  if (!USUB_STANDARD_PROPS("FRIC_COEF", props, *nProps) ||
      !USUB_STATES_NEEDED(STANDARD, USUB_STATES_TEXT("FRIC_COEF"), props, *nProps,
                          usub_scalars(props, *nProps), iData[4]) ||
      !USUB_STANDARD_NEEDS(n < 2 || usub_scalars(props, *nProps) == 0, USUB_ONE_POINT_TEXT,
                           usub_scalars(props, *nProps), n))
    return;
  for (int k = 0; k < n; ++k) {
    double mu[USUB_COEFFICIENTS], derivative[USUB_COEFFICIENTS][4] = {{0}};
    usub_ask(
        USUB_RATE(slipData[k]), USUB_PRESSURE(pressure[k] > 0 ? pressure[k] : 0),
        USUB_TEMPERATURE(*nTemp > 0 ? tempAvg[k] : 0.0),
        USUB_FIELDS(usub_mean_fields(usub_fields_room, *nFields, fieldAvg + k, n, fieldAvg + k, n)),
        USUB_SLIP(slipData[k] * rData[2]), USUB_TIME(rData[2]), USUB_STATE(rData + 7), props,
        *nProps, mu, derivative);
    for (int m = 0; m < USUB_COEFFICIENTS_OF(iData[5]); ++m) {
      double *out = fCoefDeriv + k + (ptrdiff_t)n * 20 * m;
      fCoef[k + (ptrdiff_t)n * m] = mu[m];
      for (int j = 0; j < 3; ++j)
        out[(ptrdiff_t)n * j] = derivative[m][j];
#ifdef USUB_LAW_READS_SLIP
      out[(ptrdiff_t)n * 5] = derivative[m][3];
#endif
    }
  }
}
#endif

#include "law/end.h"
#endif

#endif
