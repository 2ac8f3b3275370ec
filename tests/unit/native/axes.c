/* SPDX-License-Identifier: MIT */
/* The inline functions of axes.h as symbols, for the tests. */
#include "axes.h"

#define EXPORT(real, suffix)                                                                       \
  real norm2_##suffix(real x, real y) {                                                            \
    return usub_norm2_##suffix(x, y);                                                              \
  }                                                                                                \
  real norm3_##suffix(real x, real y, real z) {                                                    \
    return usub_norm3_##suffix(x, y, z);                                                           \
  }                                                                                                \
  real tangential2_##suffix(const real *slip, const real *n, real *v) {                            \
    return usub_tangential2_##suffix(slip, n, v);                                                  \
  }                                                                                                \
  real tangential3_##suffix(const real *slip, const real *n, real *v) {                            \
    return usub_tangential3_##suffix(slip, n, v);                                                  \
  }                                                                                                \
  real axes2_##suffix(const real *slip, const real *n, real *t1, real *t2) {                       \
    real length;                                                                                   \
    (void)t2;                                                                                      \
    usub_axes2_##suffix(slip, n, t1, &length);                                                     \
    return length;                                                                                 \
  }                                                                                                \
  real axes3_##suffix(const real *slip, const real *n, real *t1, real *t2) {                       \
    real length;                                                                                   \
    usub_axes3_##suffix(slip, n, t1, t2, &length);                                                 \
    return length;                                                                                 \
  }

EXPORT(double, d)
EXPORT(float, f)

double product_quotient(double a, double b, double c) {
  return usub_product_quotient(a, b, c);
}
