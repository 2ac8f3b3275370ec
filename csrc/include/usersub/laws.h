/* SPDX-License-Identifier: MIT */
/** @file laws.h
 * From one point function to routines behind the interfaces: what `coefficient_law.h` and
 * `traction_law.h` share, VFRIC and VFRICTION included.
 *
 * A law is a file of this form (`traction_law.h` for a shear traction instead of a coefficient):
 *
 *     #define USUB_LAW "exponential_decay"   name, for messages
 *     #define USUB_LAW_PROPS 3               least number of properties (may use props and count)
 *     #define USUB_LAW_READS_RATE            which of rate, pressure and temperature are read;
 *     #include <usersub/coefficient_law.h>   what is not read is neither fetched nor passed
 *
 *     USUB_LAW_FUNCTION {
 *       const usub_real transition = (props[0] - props[1]) * usub_bounded_exp(-props[2] * rate);
 *       if (derivative) derivative[0] = -props[2] * transition;
 *       return props[1] + transition;
 *     }
 *
 * Arguments of the point function: `rate`, the magnitude of the slip rate; `pressure`;
 * `temperature`, the mean of both surfaces (0 where the scene has none); `props`, `count`;
 * `derivative`, NULL or three zeros to fill with the derivatives by these three.
 * FRIC and FRIC_COEF exist in double precision only and are left out under USUB_SINGLE.
 */
#ifndef USERSUB_LAWS_H
#define USERSUB_LAWS_H

#include <math.h>
#include <stddef.h>

#include "abi.h"

#ifndef USUB_LAW
#error "define USUB_LAW (name), USUB_LAW_PROPS and USUB_LAW_READS_... before this header"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Utility routines of the solver: message, end of the analysis. */
void stdb_abqerr_(const int *level, const char *text, const int *ints, const double *reals,
                  const char *words, size_t text_length, size_t word_length);
void xplb_abqerr_(const int *level, const char *text, const int *ints, const usub_real *reals,
                  const char *words, size_t text_length, size_t word_length);
void xit_(void);
void xplb_exit_(void);

#if defined(__GNUC__)
#define USUB_MAY_BE_UNUSED __attribute__((unused))
#define USUB_RESTRICT __restrict__
#define USUB_NOT_INLINED __attribute__((noinline))
#else
#define USUB_MAY_BE_UNUSED
#define USUB_RESTRICT
#define USUB_NOT_INLINED
#endif

/* Opens the definition of the point function; below, its declaration. */
#define USUB_LAW_FUNCTION                                                                          \
  static inline usub_real usub_law(                                                                \
      USUB_MAY_BE_UNUSED const usub_real rate, USUB_MAY_BE_UNUSED const usub_real pressure,        \
      USUB_MAY_BE_UNUSED const usub_real temperature, USUB_MAY_BE_UNUSED const usub_real *props,   \
      USUB_MAY_BE_UNUSED const int count, USUB_MAY_BE_UNUSED usub_real *derivative)
USUB_LAW_FUNCTION;

/* The expression of an input, or zero where the law does not read it: then the argument behind it
 * is not used at all, and a driver leaves it out. */
#ifdef USUB_LAW_READS_RATE
#define USUB_RATE(expression) (expression)
#else
#define USUB_RATE(expression) 0
#endif
#ifdef USUB_LAW_READS_PRESSURE
#define USUB_PRESSURE(expression) (expression)
#else
#define USUB_PRESSURE(expression) 0
#endif
#ifdef USUB_LAW_READS_TEMPERATURE
#define USUB_TEMPERATURE(expression) (expression)
#else
#define USUB_TEMPERATURE(expression) 0
#endif

/* exp(x) for x <= 0. The bound keeps the result a normal number: others are many times slower and
 * change nothing that a coefficient could show. Written so that it costs one instruction. */
static inline usub_real usub_bounded_exp(usub_real x) {
#ifdef USUB_SINGLE
  return expf(x > -80.0f ? x : -80.0f);
#else
  return exp(x > -700.0 ? x : -700.0);
#endif
}

static inline usub_real usub_abs(usub_real x) {
  return x < 0 ? -x : x;
}

static inline usub_real usub_smaller(usub_real a, usub_real b) {
  return b < a ? b : a;
}

/* Quotient, or zero where there is nothing to divide by. */
static inline usub_real usub_ratio(usub_real numerator, usub_real denominator) {
  return denominator > 0 ? numerator / denominator : (usub_real)0;
}

/* Least number of properties; USUB_LAW_PROPS may use the properties themselves and their number. */
static inline int usub_needed(USUB_MAY_BE_UNUSED const usub_real *props,
                              USUB_MAY_BE_UNUSED int count) {
  return USUB_LAW_PROPS;
}

#define USUB_PROPS_TEXT(interface) USUB_LAW " behind " interface " needs %I properties, not %I"

/* Ends the analysis of an explicit scene that gives too few properties. */
static inline int usub_explicit_props(const char *text, size_t length, const usub_real *props,
                                      int given) {
  const int level = -3, ints[2] = {usub_needed(props, given), given};
  const usub_real reals[1] = {0};
  if (given >= ints[0])
    return 1;
  xplb_abqerr_(&level, text, ints, reals, "        ", length, 8);
  xplb_exit_();
  return 0;
}
#define USUB_EXPLICIT_PROPS(interface)                                                             \
  usub_explicit_props(USUB_PROPS_TEXT(interface), sizeof USUB_PROPS_TEXT(interface) - 1, props,    \
                      *nProps)

/* Friction force without the bound by the stick force: of a coefficient, or of a traction. */
#ifdef USUB_LAW_GIVES_TRACTION
#define USUB_FORCE(law, normal_force, area) ((law) * (area))
#else
#define USUB_FORCE(law, normal_force, area) ((law) * (normal_force))
#endif

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  if (!USUB_EXPLICIT_PROPS("VFRIC"))
    return;
  for (int i = 0; i < *nContact; ++i) {
    if (!(fNormal[i] > 0))
      continue;
    const usub_real law =
        usub_law(USUB_RATE(usub_ratio(usub_abs(dSlipFric[(ptrdiff_t)i * *nDir]), *dTimCur)),
                 USUB_PRESSURE(usub_ratio(fNormal[i], areaSec[jConSecid[i] - 1])),
                 USUB_TEMPERATURE(
                     *nTemp > 0 ? (usub_real)0.5 *
                                      (tempSec[i] + tempMain[i < *numDefTfv ? i : *numDefTfv - 1])
                                : (usub_real)0),
                 props, *nProps, NULL);
    fTangential[(ptrdiff_t)i * *nFricDir] =
        -usub_smaller(USUB_FORCE(law, fNormal[i], areaSec[jConSecid[i] - 1]), fStickForce[i]);
  }
}

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  if (!USUB_EXPLICIT_PROPS("VFRICTION"))
    return;
  for (int k = 0; k < *nBlock; ++k) {
    if (!(fNormal[k] > 0))
      continue;
    const usub_real law =
        usub_law(USUB_RATE(usub_ratio(usub_abs(dSlipFric[(ptrdiff_t)k * *nDir]), rData[2])),
                 USUB_PRESSURE(usub_ratio(fNormal[k], areaCont[k])),
                 USUB_TEMPERATURE(
                     *nTemp > 0 ? (usub_real)0.5 *
                                      (tempSec[k] + tempMain[k < *nBlockAnal ? k : *nBlockAnal - 1])
                                : (usub_real)0),
                 props, *nProps, NULL);
    fTangential[(ptrdiff_t)k * *nFricDir] =
        -usub_smaller(USUB_FORCE(law, fNormal[k], areaCont[k]), fStickForce[k]);
  }
}

#ifndef USUB_SINGLE
/* Ends an implicit analysis unless `holds`; `text` has two %I for the numbers. */
static inline int usub_standard_needs(int holds, const char *text, size_t length, int first,
                                      int second) {
  const int level = -3, ints[2] = {first, second};
  const double reals[1] = {0};
  if (holds)
    return 1;
  stdb_abqerr_(&level, text, ints, reals, "        ", length, 8);
  xit_();
  return 0;
}
#define USUB_STANDARD_NEEDS(holds, text, first, second)                                            \
  usub_standard_needs(holds, text, sizeof(text) - 1, first, second)
#define USUB_STANDARD_PROPS(interface, props, count)                                               \
  USUB_STANDARD_NEEDS((count) >= usub_needed(props, count), USUB_PROPS_TEXT(interface),            \
                      usub_needed(props, count), count)

/* Length of a vector of one or two components. */
static inline double usub_length(int directions, const double *vector) {
  return directions > 1 ? hypot(vector[0], vector[1]) : fabs(vector[0]);
}
#endif

#ifdef __cplusplus
}
#endif

#endif
