/* SPDX-License-Identifier: MIT */
/** @file law/point.h
 * The point function of a coefficient, strength or traction (part of their headers).
 */
#ifndef USERSUB_LAW_POINT_H
#define USERSUB_LAW_POINT_H

#include "../laws.h"

#ifdef USUB_LAW_ANISOTROPIC
#define USUB_COEFFICIENTS 2
#define USUB_LAW_RESULT(number) void
#define USUB_LAW_OUTPUT(number)                                                                    \
  USUB_MAY_BE_UNUSED number *mu, USUB_MAY_BE_UNUSED usub_real(*derivative)[4]
#else
#define USUB_COEFFICIENTS 1
#define USUB_LAW_RESULT(number) number
#define USUB_LAW_OUTPUT(number) USUB_MAY_BE_UNUSED usub_real *derivative
#endif

/* Arguments in the type `number` of what carries derivatives. */
#define USUB_LAW_INPUTS(number)                                                                    \
  USUB_MAY_BE_UNUSED const number rate, USUB_MAY_BE_UNUSED const number pressure,                  \
      USUB_MAY_BE_UNUSED const number temperature, USUB_MAY_BE_UNUSED const usub_real *fields,     \
      USUB_MAY_BE_UNUSED const number slip, USUB_MAY_BE_UNUSED const usub_real time_increment,     \
      USUB_MAY_BE_UNUSED number *state, USUB_MAY_BE_UNUSED const usub_real *props,                 \
      USUB_MAY_BE_UNUSED const int count
#define USUB_LAW_ARGUMENTS(number) USUB_LAW_INPUTS(number), USUB_LAW_OUTPUT(number)

/* Opens the definition of the point function; below, its declaration. */
#define USUB_LAW_FUNCTION                                                                          \
  USUB_MAY_BE_UNUSED static inline USUB_LAW_RESULT(usub_value)                                     \
      usub_law(USUB_LAW_ARGUMENTS(usub_value))
USUB_LAW_FUNCTION;

#if defined(USUB_LAW_DUAL) && !defined(USUB_SINGLE)
#ifdef __cplusplus
extern "C" {
#endif
/* The point function with derivatives, from the second reading of the file. */
USUB_HIDDEN USUB_LAW_RESULT(usub_real) usub_law_dual(USUB_LAW_ARGUMENTS(usub_real));
#ifdef __cplusplus
}
#endif
#endif

#ifdef USUB_DUAL_PASS
/* State variables enter as values: they belong to the start of the increment. */
USUB_LAW_RESULT(usub_real) usub_law_dual(USUB_LAW_ARGUMENTS(usub_real)) {
  usub_dual room[USUB_LAW_MOST];
  const int states = usub_scalars(props, count);
  for (int i = 0; i < states; ++i)
    room[i] = state[i];
  const usub_dual r = usub_dual::variable(rate, 0), p = usub_dual::variable(pressure, 1);
  const usub_dual t = usub_dual::variable(temperature, 2), s = usub_dual::variable(slip, 3);
#ifdef USUB_LAW_ANISOTROPIC
  usub_dual value[2] = {0.0, 0.0};
  usub_law(r, p, t, fields, s, time_increment, room, props, count, value, NULL);
  for (int i = 0; i < 2; ++i) {
    mu[i] = value[i].v;
    for (int j = 0; j < 4 && derivative; ++j)
      derivative[i][j] = value[i].d[j];
  }
#else
  const usub_dual value = usub_law(r, p, t, fields, s, time_increment, room, props, count, NULL);
  for (int j = 0; j < 4 && derivative; ++j)
    derivative[j] = value.d[j];
#endif
  for (int i = 0; i < states; ++i)
    state[i] = room[i].v;
#ifndef USUB_LAW_ANISOTROPIC
  return value.v;
#endif
}
#endif

#if !defined(USUB_SINGLE) && !defined(USUB_DUAL_PASS)
/* The result, or both coefficients, with derivatives; `derivative` holds zeros on entry. */
static inline void usub_ask(USUB_LAW_INPUTS(double), double *result, double (*derivative)[4]) {
#ifdef USUB_LAW_DUAL
#define USUB_LAW_CALLED usub_law_dual
#else
#define USUB_LAW_CALLED usub_law
#endif
#ifdef USUB_LAW_ANISOTROPIC
  USUB_LAW_CALLED(rate, pressure, temperature, fields, slip, time_increment, state, props, count,
                  result, derivative);
#else
  *result = USUB_LAW_CALLED(rate, pressure, temperature, fields, slip, time_increment, state, props,
                            count, *derivative);
#endif
#undef USUB_LAW_CALLED
}
#endif

#endif
