/* SPDX-License-Identifier: MIT */
/** @file powers.h
 * Powers inside exponentials and products (part of `law_functions.h`). Each digit of a power that
 * is lost is lost to its exponential as often as the power is large, and each factor of a product
 * adds its errors: here logarithms have some ten bits more than a double, and the results are exact
 * to about a unit in the last place.
 */
#ifndef USERSUB_LAW_POWERS_H
#define USERSUB_LAW_POWERS_H

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "pair.h"

/* Logarithm of a number that is positive and normal. With x = 2^e m and s = (m - 1)/(m + 1) it is
 * e log 2 + 2 artanh s. The high part of log 2 has so few digits that the product is exact. */
static inline usub_pair usub_log_of_normal(double x) {
  uint64_t bits, excess;
  double m;
  memcpy(&bits, &x, sizeof bits);
  excess = bits - 0x3fe6a09e667f3bcd; /* the bits of the root of 1/2 */
  bits -= excess & 0xfff0000000000000;
  memcpy(&m, &bits, sizeof m);
  const double e = (double)((int64_t)excess >> 52);
  const double top = m - 1, bottom = m + 1, lost = m - (bottom - 1);
  const double inverse = 1 / bottom, s = top * inverse, t = s * s, t2 = t * t, t4 = t2 * t2;
  const double series = ((2.0 / 3 + 2.0 / 5 * t) + (2.0 / 7 + 2.0 / 9 * t) * t2) +
                        ((2.0 / 11 + 2.0 / 13 * t) + (2.0 / 15 + 2.0 / 17 * t) * t2) * t4 +
                        ((2.0 / 19 + 2.0 / 21 * t) + 2.0 / 23 * t2) * (t4 * t4);
  const double rest = 2 * (fma(-s, bottom, top) - s * lost) * inverse + s * t * series +
                      e * 1.90821492927058770002e-10;
  const double large = e * 6.93147180369123816490e-01, sum = large + 2 * s;
  const double small = (e == 0 ? 0 : 2 * s - (sum - large)) + rest;
  const usub_pair logarithm = {sum + small, small - ((sum + small) - sum)};
  return logarithm;
}

/* exponent * log(base), which a product of powers adds up; 0 where the exponent is 0. */
static inline usub_pair usub_log_of_power(usub_pair base, double exponent) {
  usub_pair x = {0, 0};
  if (exponent == 0)
    return x;
  if (base.high >= DBL_MIN && base.high <= DBL_MAX) {
    x = usub_log_of_normal(base.high);
  } else if (base.high > 0 && base.high < DBL_MIN) {
    const usub_pair shift = {37.42994775023705, -1.1902053746983427e-15}; /* 54 log 2 */
    x = usub_pair_less(usub_log_of_normal(base.high * 18014398509481984.0), shift);
  } else {
    x.high = base.high == 0 ? -HUGE_VAL : base.high;
  }
  x.low += base.low / base.high;
  const usub_pair power = usub_product(exponent, x.high);
  return usub_pair_of(power.high, power.low + exponent * x.low);
}

/* exp(x), by one step of Newton's method from that of the high part. */
static inline usub_pair usub_pair_exp(usub_pair x) {
  usub_pair y = {exp(x.high), 0};
  if (y.high >= DBL_MIN && y.high <= DBL_MAX) {
    const usub_pair logarithm = usub_log_of_normal(y.high);
    y.low = y.high * ((x.high - logarithm.high) + (x.low - logarithm.low));
  }
  return y;
}

/* (x - start)/(end - start). */
static inline usub_pair usub_share(double x, double start, double end) {
  const double share = x / end;
  const usub_pair of_end = {share, fma(-share, end, x) / end};
  return start == 0 ? of_end : usub_pair_over(usub_sum(x, -start), usub_sum(end, -start));
}

/* exp(-((x - start)/(end - start))^exponent), 1 before start; `slope` receives its derivative by x,
 * at start from above, or 0 where it has no finite one (exponent below 1). */
USUB_MAY_BE_UNUSED static inline usub_real usub_decay_of_power(double x, double start, double end,
                                                               double exponent, usub_real *slope) {
  *slope = 0;
  if (!(x > start)) {
    if (x == start && exponent == 1 && end > start)
      *slope = (usub_real)(-1 / (end - start));
    return x <= start ? 1 : (usub_real)x;
  }
  if (!(end > start)) /* a step */
    return 0;
  const usub_pair power = usub_pair_exp(usub_log_of_power(usub_share(x, start, end), exponent));
  const double decay = exp(-power.high);
  if (!(decay > 0))
    return 0;
  *slope = (usub_real)(-decay * (exponent * (power.high / (x - start))));
  return (usub_real)(decay - decay * power.low);
}

/* 1 - ((x - start)/(end - start))^exponent, 1 before start, 0 beyond end; `slope` as above. */
USUB_MAY_BE_UNUSED static inline usub_real usub_drop_of_power(double x, double start, double end,
                                                              double exponent, usub_real *slope) {
  *slope = 0;
  if (!(x > start)) {
    if (x == start && exponent == 1 && end > start)
      *slope = (usub_real)(-1 / (end - start));
    return x <= start ? 1 : (usub_real)x;
  }
  if (x >= end)
    return 0;
  const usub_pair power = usub_log_of_power(usub_share(x, start, end), exponent);
  const double less = expm1(power.high);
  *slope = (usub_real)(-exponent * (exp(power.high) / (x - start)));
  return (usub_real)(-less - power.low * (1 + less));
}

/* factor * bases[0]^exponents[0] * ... of n numbers that are not negative; as it is one exponential
 * of a sum, no part of it overflows before the product does. */
USUB_MAY_BE_UNUSED static inline usub_real
usub_product_of_powers(double factor, int n, const usub_real *bases, const usub_real *exponents) {
  const usub_pair first = {factor, 0};
  usub_pair sum = usub_log_of_power(first, 1);
  for (int i = 0; i < n; ++i) {
    const usub_pair base = {bases[i], 0}, power = usub_log_of_power(base, exponents[i]);
    const usub_pair both = usub_sum(sum.high, power.high);
    sum.low = fabs(both.high) <= DBL_MAX ? both.low + (sum.low + power.low) : 0;
    sum.high = both.high;
  }
  const double product = exp(sum.high);
  return (usub_real)(product <= DBL_MAX ? product + product * sum.low : product);
}

#endif
