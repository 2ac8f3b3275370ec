/* SPDX-License-Identifier: MIT */
/** @file law_functions.h
 * Functions that several laws need and that plain formulas spoil by cancellation. Included by a
 * law's file after the header of its kind.
 */
#ifndef USERSUB_LAW_FUNCTIONS_H
#define USERSUB_LAW_FUNCTIONS_H

#include <float.h>

#include "law/powers.h"

/* Smallest normal number: a state that falls below is no state that was never set, which is 0. */
#ifdef USUB_SINGLE
#define USUB_TINY FLT_MIN
#else
#define USUB_TINY DBL_MIN
#endif

/* Whether a positive number has neither overflown nor lost digits. */
#ifdef USUB_SINGLE
#define usub_is_normal(x) ((x) >= FLT_MIN && (x) <= FLT_MAX)
#else
#define usub_is_normal(x) ((x) >= DBL_MIN && (x) <= DBL_MAX)
#endif

/* A force that was left at its limit is rounded: up to here times the limit it has not moved on. */
#ifdef USUB_SINGLE
#define USUB_ROUNDED (1 + 4 * FLT_EPSILON)
#else
#define USUB_ROUNDED (1 + 4 * DBL_EPSILON)
#endif

/* Largest argument of exp that leaves room for a factor. */
#ifdef USUB_SINGLE
#define USUB_MOST_EXPONENT 70.0f
#else
#define USUB_MOST_EXPONENT 600.0
#endif

/* Mean of exp(-t) for t from 0 to x, (1 - exp(-x))/x, for x >= 0; `slope` receives its derivative.
 * A series below the corner: there the plain formulas lose digits, and all of them at zero. */
static inline usub_real usub_mean_decay(usub_real x, usub_real *slope) {
  if (!(x < (usub_real)0.25)) {
    const usub_real mean = -expm1(-x) / x;
    *slope = (exp(-x) - mean) / x;
    return mean;
  }
  usub_real mean = 1;
  *slope = 0;
  for (int n = 12; n > 1; --n) {
    *slope = -(mean + x * *slope) / (usub_real)n;
    mean = 1 - x * mean / (usub_real)n;
  }
  return mean;
}

/* Slip over its distance from which on a state is the steady one in all digits. The formulas of the
 * way there would overflow before their result does. */
#define USUB_STEADY ((usub_real)1e30)

/* log(factor * above / below) of positive numbers, also where the ratio is no number any more. */
USUB_MAY_BE_UNUSED static inline usub_real usub_log_scaled(usub_real factor, usub_real above,
                                                           usub_real below) {
  const usub_real ratio = above / below, value = factor * ratio;
  return usub_is_normal(ratio) && usub_is_normal(value) ? log(value)
                                                        : log(factor) + log(above) - log(below);
}

/* State variable of the ageing law, d theta/dt = 1 - rate theta/distance, after an increment, and
 * its derivative by the rate. Exact for a constant rate, without cancellation at small and overflow
 * at large slip. */
USUB_MAY_BE_UNUSED static inline usub_real usub_aged(usub_real theta, usub_real rate,
                                                     usub_real time_increment, usub_real distance,
                                                     usub_real *by_rate) {
  const usub_real x = rate * time_increment / distance, kept = theta * exp(-x);
  usub_real slope;
  if (x > USUB_STEADY) {
    const usub_real steady = distance / rate;
    *by_rate = -steady / rate;
    return steady > USUB_TINY ? steady : USUB_TINY;
  }
  const usub_real grown = time_increment * usub_mean_decay(x, &slope);
  *by_rate = time_increment / distance * (time_increment * slope - kept);
  return kept + grown > USUB_TINY ? kept + grown : USUB_TINY;
}

/* asinh(ratio exp(exponent)) for ratio >= 0, where exp(exponent) may be too large for a number;
 * derivatives by ratio and by exponent. */
USUB_MAY_BE_UNUSED static inline usub_real usub_asinh_product(usub_real ratio, usub_real exponent,
                                                              usub_real *by_ratio,
                                                              usub_real *by_exponent) {
  const usub_real size = ratio > 0 ? log(ratio) + exponent : 0;
  if (size > 0) {
    const usub_real root = sqrt(1 + exp(-2 * size));
    *by_exponent = 1 / root;
    *by_ratio = *by_exponent / ratio;
    return size + log1p(root);
  }
  const usub_real factor = exp(exponent < USUB_MOST_EXPONENT ? exponent : USUB_MOST_EXPONENT);
  const usub_real x = ratio * factor, root = sqrt(1 + x * x);
  *by_exponent = x / root;
  *by_ratio = factor / root;
  return asinh(x);
}

/* asinh(rate/reference exp(exponent)) for rate >= 0 and reference > 0, where rate/reference, too,
 * may be too large for a number; derivatives by rate and by exponent. */
USUB_MAY_BE_UNUSED static inline usub_real usub_asinh_rate(usub_real rate, usub_real reference,
                                                           usub_real exponent, usub_real *by_rate,
                                                           usub_real *by_exponent) {
  /* 2^-64 and its logarithm: what the ratio is smaller by, the exponential is larger by */
  const usub_real less = (usub_real)5.421010862427522e-20, more = (usub_real)44.3614195558365;
  const int far = !(rate / reference < (sizeof(usub_real) == sizeof(double) ? DBL_MAX : FLT_MAX));
  const usub_real unit = far ? less : 1;
  const usub_real value = usub_asinh_product(
      unit * rate / reference, far ? exponent + more : exponent, by_rate, by_exponent);
  *by_rate *= unit / reference;
  return value;
}

/* Coefficient of steady sliding of a Stribeck curve without viscous part,
 * kinetic + (static - kinetic) exp(-(rate/velocity)^exponent), and its derivative by the rate. */
USUB_MAY_BE_UNUSED static inline usub_real usub_stribeck(usub_real rate, usub_real at_rest,
                                                         usub_real kinetic, usub_real velocity,
                                                         usub_real exponent, usub_real *slope) {
  const usub_real decay = usub_decay_of_power(rate, 0, velocity, exponent, slope);
  *slope *= at_rest - kinetic;
  return kinetic + (at_rest - kinetic) * decay;
}

#endif
