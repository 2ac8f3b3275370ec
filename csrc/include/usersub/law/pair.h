/* SPDX-License-Identifier: MIT */
/** @file pair.h
 * Numbers of twice the digits (part of `law_functions.h` and `law_table.h`): a pair stands for the
 * sum of a double and of a second one below its last place.
 */
#ifndef USERSUB_LAW_PAIR_H
#define USERSUB_LAW_PAIR_H

#include <math.h>

typedef struct usub_pair {
  double high, low;
} usub_pair;

/* high + low; next to an infinity the low part, which is a remainder, is no number and left out. */
static inline usub_pair usub_pair_of(double high, double low) {
  const usub_pair x = {high, fabs(low) < fabs(high) ? low : 0};
  return x;
}

/* a + b, exactly. */
static inline usub_pair usub_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return usub_pair_of(sum, (a - (sum - part)) + (b - part));
}

/* a * b, exactly. */
static inline usub_pair usub_product(double a, double b) {
  const double product = a * b;
  return usub_pair_of(product, fma(a, b, -product));
}

static inline usub_pair usub_pair_add(usub_pair x, usub_pair y) {
  const usub_pair high = usub_sum(x.high, y.high), low = usub_sum(x.low, y.low);
  const usub_pair sum = usub_sum(high.high, high.low + low.high);
  return usub_sum(sum.high, sum.low + low.low);
}

static inline usub_pair usub_pair_less(usub_pair x, usub_pair y) {
  const usub_pair minus = {-y.high, -y.low};
  return usub_pair_add(x, minus);
}

static inline usub_pair usub_pair_times(usub_pair x, usub_pair y) {
  const usub_pair product = usub_product(x.high, y.high);
  const double rest = product.low + (x.high * y.low + x.low * y.high);
  return usub_pair_of(product.high, rest);
}

static inline usub_pair usub_pair_over(usub_pair x, usub_pair y) {
  const double quotient = x.high / y.high;
  const usub_pair product = usub_product(quotient, y.high);
  const double rest = ((x.high - product.high) - product.low + x.low) - quotient * y.low;
  return usub_pair_of(quotient, rest / y.high);
}

/* Square root of a number that is not negative. */
static inline usub_pair usub_pair_sqrt(usub_pair x) {
  usub_pair root = {sqrt(x.high), 0};
  const usub_pair square = usub_product(root.high, root.high);
  if (root.high > 0)
    root.low = 0.5 * (((x.high - square.high) - square.low) + x.low) / root.high;
  return root;
}

#endif
