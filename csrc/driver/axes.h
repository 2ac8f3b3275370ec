/* SPDX-License-Identifier: MIT */
/** @file axes.h
 * Local axes of a contact point, for double (suffix _d) and float (suffix _f).
 *
 * All functions are free of overflow and underflow for slips from the smallest denormal up to
 * 1e300 (1e37 in single): a range check on the sum of squares keeps the usual case at one square
 * root and one division, everything else is repeated after scaling by a power of two.
 * Normals have to be of unit length to rounding. NaN or infinity in gives NaN out.
 *
 *   R usub_norm2_{d,f}(x, y), usub_norm3_{d,f}(x, y, z)    length of a vector
 *   R usub_tangential2_{d,f}(slip, n, v)                   part of slip in the plane of n, and its
 *   R usub_tangential3_{d,f}(slip, n, v)                   length; a part of at most 4 eps |slip|
 *                                                          is rounding and counts as zero
 *   void usub_zero_slip_axis_{d,f}(n, t1)                  t1 where there is no slip
 *   void usub_axes2_{d,f}(slip, n, t1, &length)            t1 of two dimensions
 *   void usub_axes3_{d,f}(slip, n, t1, t2, &length)        t1 and t2 = n x t1
 *   double usub_product_quotient(a, b, c)                  a b / c (double only)
 */
#if !defined(USUB_AXES_REAL)

#ifndef USUB_AXES_H
#define USUB_AXES_H

#include <float.h>
#include <math.h>

/** a b / c without overflow or underflow of a partial result; a, b, c finite, c not zero. */
static inline double usub_product_quotient(double a, double b, double c) {
  if (a == 0.0 || b == 0.0) {
    return 0.0;
  }
  const double product = a * b;
  const double size = fabs(product);
  if (size > 1e-290 && size < 1e290) {
    return product / c;
  }
  int ea, eb, ec;
  const double ma = frexp(a, &ea), mb = frexp(b, &eb), mc = frexp(c, &ec);
  return ldexp(ma * mb / mc, ea + eb - ec);
}

/* The body below is read once for each precision. FLOOR and CEILING bound the sums of squares that
 * lose nothing; FLOOR leaves room for a tangential part of 4 eps |slip|. */
#define USUB_AXES_REAL double
#define USUB_AXES_NAME(name) name##_d
#define USUB_AXES_MATH(name) name
#define USUB_AXES_EPSILON DBL_EPSILON
#define USUB_AXES_FLOOR 1e-240
#define USUB_AXES_CEILING 1e300
#include "axes.h"
#undef USUB_AXES_REAL
#undef USUB_AXES_NAME
#undef USUB_AXES_MATH
#undef USUB_AXES_EPSILON
#undef USUB_AXES_FLOOR
#undef USUB_AXES_CEILING

#define USUB_AXES_REAL float
#define USUB_AXES_NAME(name) name##_f
#define USUB_AXES_MATH(name) name##f
#define USUB_AXES_EPSILON FLT_EPSILON
#define USUB_AXES_FLOOR 1e-24f
#define USUB_AXES_CEILING 1e36f
#include "axes.h"
#undef USUB_AXES_REAL
#undef USUB_AXES_NAME
#undef USUB_AXES_MATH
#undef USUB_AXES_EPSILON
#undef USUB_AXES_FLOOR
#undef USUB_AXES_CEILING

#endif /* USUB_AXES_H */

#else /* body for one precision */

#define R USUB_AXES_REAL
#define F USUB_AXES_NAME
#define M USUB_AXES_MATH

/** Exponent e such that the components times 2^-e are at most 1 in size; 0 for the zero vector. */
static inline int F(usub_axes_exponent)(R x, R y, R z) {
  const R size = M(fmax)(M(fmax)(M(fabs)(x), M(fabs)(y)), M(fabs)(z));
  int exponent = 0;
  if (isfinite(size)) {
    (void)M(frexp)(size, &exponent);
  }
  return exponent;
}

static inline R F(usub_norm3)(R x, R y, R z) {
  const R sum = x * x + y * y + z * z;
  if (sum >= USUB_AXES_FLOOR && sum <= USUB_AXES_CEILING) {
    return M(sqrt)(sum);
  }
  const int e = F(usub_axes_exponent)(x, y, z);
  x = M(ldexp)(x, -e);
  y = M(ldexp)(y, -e);
  z = M(ldexp)(z, -e);
  return M(ldexp)(M(sqrt)(x * x + y * y + z * z), e);
}

static inline R F(usub_norm2)(R x, R y) {
  return F(usub_norm3)(x, y, (R)0);
}

static inline void F(usub_axes_project)(const R a[3], const R n[3], R v[3]) {
  const R along = a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
  v[0] = a[0] - along * n[0];
  v[1] = a[1] - along * n[1];
  v[2] = a[2] - along * n[2];
}

/** Whether a sum of squares has neither overflown nor underflown. */
static inline int F(usub_axes_is_usual)(R whole) {
  return (whole >= USUB_AXES_FLOOR) & (whole <= USUB_AXES_CEILING);
}

/** Tangential part, squared, over the whole that is rounding: (4 eps)^2. */
static inline R F(usub_axes_noise)(void) {
  return (R)16 * USUB_AXES_EPSILON * USUB_AXES_EPSILON;
}

/** Projection of a slip whose squares neither overflow nor underflow; returns |v|. */
static inline R F(usub_axes_tangential3)(const R slip[3], const R n[3], R v[3]) {
  const R noise = F(usub_axes_noise)();
  const R whole = slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2];
  F(usub_axes_project)(slip, n, v);
  R part = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if (part < (R)0.25 * whole) {
    /* The rounding error left along n is eps |slip|: not small against v, so take it out too. */
    const R once[3] = {v[0], v[1], v[2]};
    F(usub_axes_project)(once, n, v);
    part = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  }
  if (part <= noise * whole) {
    v[0] = v[1] = v[2] = (R)0;
    return (R)0;
  }
  return M(sqrt)(part);
}

static inline R F(usub_tangential3)(const R slip[3], const R n[3], R v[3]) {
  const R whole = slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2];
  if (whole >= USUB_AXES_FLOOR && whole <= USUB_AXES_CEILING) {
    return F(usub_axes_tangential3)(slip, n, v);
  }
  const int e = F(usub_axes_exponent)(slip[0], slip[1], slip[2]);
  const R scaled[3] = {M(ldexp)(slip[0], -e), M(ldexp)(slip[1], -e), M(ldexp)(slip[2], -e)};
  const R length = F(usub_axes_tangential3)(scaled, n, v);
  v[0] = M(ldexp)(v[0], e);
  v[1] = M(ldexp)(v[1], e);
  v[2] = M(ldexp)(v[2], e);
  return M(ldexp)(length, e);
}

/** In two dimensions the tangent is known: only the sign and the length depend on the slip. */
static inline void F(usub_axes2)(const R slip[2], const R n[2], R t1[2], R *length) {
  const R noise = F(usub_axes_noise)();
  R x = slip[0], y = slip[1];
  R whole = x * x + y * y;
  int e = 0;
  if (!(whole >= USUB_AXES_FLOOR && whole <= USUB_AXES_CEILING)) {
    e = F(usub_axes_exponent)(x, y, (R)0);
    x = M(ldexp)(x, -e);
    y = M(ldexp)(y, -e);
    whole = x * x + y * y;
    if (!isfinite(whole)) { /* infinity would count as rounding of itself below */
      *length = t1[0] = t1[1] = whole - whole;
      return;
    }
  }
  const R along = x * n[1] - y * n[0];
  if (along * along <= noise * whole) {
    *length = (R)0;
    t1[0] = n[1];
    t1[1] = -n[0];
    return;
  }
  *length = M(fabs)(along);
  if (e != 0) {
    *length = M(ldexp)(*length, e);
  }
  t1[0] = along < (R)0 ? -n[1] : n[1];
  t1[1] = along < (R)0 ? n[0] : -n[0];
}

static inline R F(usub_tangential2)(const R slip[2], const R n[2], R v[2]) {
  R t1[2], length;
  F(usub_axes2)(slip, n, t1, &length);
  v[0] = length * t1[0];
  v[1] = length * t1[1];
  return length;
}

/** A unit vector orthogonal to n: the image of the x axis under the shortest rotation of the z axis
 * into n, so it is a continuous function of n except at (0, 0, -1), where it is the x axis. */
static inline void F(usub_zero_slip_axis)(const R n[3], R t1[3]) {
  R c = n[0], s = n[1], factor;
  if (n[2] >= (R)0) {
    factor = (R)1 / ((R)1 + n[2]);
  } else {
    /* 1 + n_z = (n_x^2 + n_y^2) / (1 - n_z), without the cancellation of the left side. */
    R sum = c * c + s * s;
    if (sum < USUB_AXES_FLOOR) {
      const int e = F(usub_axes_exponent)(c, s, (R)0);
      c = M(ldexp)(c, -e);
      s = M(ldexp)(s, -e);
      sum = c * c + s * s;
    }
    const R radius = M(sqrt)(sum);
    factor = (R)1 - n[2];
    c = radius > (R)0 ? c / radius : (R)0;
    s = radius > (R)0 ? s / radius : (R)0;
  }
  t1[0] = (R)1 - factor * c * c;
  t1[1] = -factor * c * s;
  t1[2] = -n[0];
  /* One step towards unit length takes out the rounding of n, which counts twice near the pole. */
  const R length = (R)1.5 - (R)0.5 * (t1[0] * t1[0] + t1[1] * t1[1] + t1[2] * t1[2]);
  t1[0] *= length;
  t1[1] *= length;
  t1[2] *= length;
}

static inline void F(usub_axes3)(const R slip[3], const R n[3], R t1[3], R t2[3], R *length) {
  const R whole = slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2];
  R v[3] = {0, 0, 0}, size;
  int e = 0;
  if (F(usub_axes_is_usual)(whole)) {
    size = F(usub_axes_tangential3)(slip, n, v);
  } else if (slip[0] == (R)0 && slip[1] == (R)0 && slip[2] == (R)0) {
    size = (R)0; /* at rest: as common as motion, and nothing to scale */
  } else {
    e = F(usub_axes_exponent)(slip[0], slip[1], slip[2]);
    const R scaled[3] = {M(ldexp)(slip[0], -e), M(ldexp)(slip[1], -e), M(ldexp)(slip[2], -e)};
    size = F(usub_axes_tangential3)(scaled, n, v);
  }
  if (size == (R)0) {
    F(usub_zero_slip_axis)(n, t1);
  } else {
    const R inverse = (R)1 / size;
    t1[0] = v[0] * inverse;
    t1[1] = v[1] * inverse;
    t1[2] = v[2] * inverse;
  }
  *length = e == 0 ? size : M(ldexp)(size, e);
  t2[0] = n[1] * t1[2] - n[2] * t1[1];
  t2[1] = n[2] * t1[0] - n[0] * t1[2];
  t2[2] = n[0] * t1[1] - n[1] * t1[0];
}

#undef R
#undef F
#undef M

#endif
