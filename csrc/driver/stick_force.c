/* SPDX-License-Identifier: MIT */
/* Stick forces of kinematic and penalty enforcement, for hosts that have none of their own. */
#include <math.h>
#include <stddef.h>

#include "axes.h"
#include "usersub/usersub.h"

/* A normal further from unit length than this is a mistake, not rounding. */
#define UNIT_TOLERANCE 1e-3

/* An array of either precision. What is a sum or a product is computed in double, so that single
 * precision can neither overflow on the way nor round twice; what is rounding in a projection is
 * decided in the precision of the host. */
typedef struct reals {
  const double *wide;
  const float *narrow;
} reals;

static inline double at(reals array, size_t i) {
  return array.wide ? array.wide[i] : (double)array.narrow[i];
}

static int present(reals array) {
  return array.wide != NULL || array.narrow != NULL;
}

static int all_finite(reals array, size_t count) {
  double sum = 0.0;
  for (size_t i = 0; i < count; ++i) {
    sum += at(array, i) * 0.0;
  }
  return sum == 0.0;
}

static int none_negative(reals array, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (at(array, i) < 0.0) {
      return 0;
    }
  }
  return all_finite(array, count);
}

static int all_unit(reals normal, size_t points, size_t dimension) {
  for (size_t i = 0; i < points; ++i) {
    double sum = 0.0;
    for (size_t j = 0; j < dimension; ++j) {
      const double x = at(normal, dimension * i + j);
      sum += x * x;
    }
    if (!(fabs(sum - 1.0) <= UNIT_TOLERANCE)) {
      return 0;
    }
  }
  return 1;
}

/* Length of the part of a vector in the plane of normal i. */
static double tangential(const double vector[3], reals normal, size_t i, size_t dimension) {
  if (normal.wide) {
    double part[3];
    const double *n = normal.wide + dimension * i;
    return dimension == 2 ? usub_tangential2_d(vector, n, part)
                          : usub_tangential3_d(vector, n, part);
  }
  float part[3];
  const float *n = normal.narrow + dimension * i;
  const float rounded[3] = {(float)vector[0], (float)vector[1], (float)vector[2]};
  return (double)(dimension == 2 ? usub_tangential2_f(rounded, n, part)
                                 : usub_tangential3_f(rounded, n, part));
}

static void put(double *wide, float *narrow, size_t i, double value) {
  if (wide) {
    wide[i] = value;
  } else {
    narrow[i] = (float)value;
  }
}

static int32_t kinematic(int32_t points, int32_t dimension, reals velocity, reals normal,
                         reals mass, double time_increment, double *wide, float *narrow) {
  const size_t n = (size_t)points, d = (size_t)dimension;
  if (points < 0 || (dimension != 2 && dimension != 3) || !(time_increment > 0.0) ||
      !isfinite(time_increment)) {
    return USUB_BAD_ARGUMENT;
  }
  if (points == 0) {
    return USUB_OK;
  }
  if (!present(velocity) || !present(normal) || !present(mass) || (!wide && !narrow) ||
      !all_finite(velocity, n * d) || !all_unit(normal, n, d) || !none_negative(mass, n)) {
    return USUB_BAD_ARGUMENT;
  }
  for (size_t i = 0; i < n; ++i) {
    double v[3] = {0.0, 0.0, 0.0};
    for (size_t j = 0; j < d; ++j) {
      v[j] = at(velocity, d * i + j);
    }
    const double speed = tangential(v, normal, i, d);
    put(wide, narrow, i, usub_product_quotient(at(mass, i), speed, time_increment));
  }
  return USUB_OK;
}

static int32_t penalty(int32_t points, int32_t dimension, reals previous, reals slip, reals normal,
                       reals stiffness, double *wide, float *narrow) {
  const size_t n = (size_t)points, d = (size_t)dimension;
  if (points < 0 || (dimension != 2 && dimension != 3)) {
    return USUB_BAD_ARGUMENT;
  }
  if (points == 0) {
    return USUB_OK;
  }
  if (!present(previous) || !present(slip) || !present(normal) || !present(stiffness) ||
      (!wide && !narrow) || !all_finite(previous, n * d) || !all_finite(slip, n * d) ||
      !all_unit(normal, n, d) || !none_negative(stiffness, n)) {
    return USUB_BAD_ARGUMENT;
  }
  for (size_t i = 0; i < n; ++i) {
    double force[3] = {0.0, 0.0, 0.0};
    for (size_t j = 0; j < d; ++j) {
      force[j] = at(previous, d * i + j) - at(stiffness, i) * at(slip, d * i + j);
    }
    put(wide, narrow, i, tangential(force, normal, i, d));
  }
  return USUB_OK;
}

int32_t usub_stick_force_kinematic(int32_t points, int32_t dimension, const double *velocity,
                                   const double *normal, const double *mass, double time_increment,
                                   double *stick_force) {
  return kinematic(points, dimension, (reals){velocity, NULL}, (reals){normal, NULL},
                   (reals){mass, NULL}, time_increment, stick_force, NULL);
}

int32_t usub_stick_force_penalty(int32_t points, int32_t dimension, const double *previous_force,
                                 const double *slip_increment, const double *normal,
                                 const double *stiffness, double *stick_force) {
  return penalty(points, dimension, (reals){previous_force, NULL}, (reals){slip_increment, NULL},
                 (reals){normal, NULL}, (reals){stiffness, NULL}, stick_force, NULL);
}

int32_t usub_stick_force_kinematic_single(int32_t points, int32_t dimension, const float *velocity,
                                          const float *normal, const float *mass,
                                          float time_increment, float *stick_force) {
  return kinematic(points, dimension, (reals){NULL, velocity}, (reals){NULL, normal},
                   (reals){NULL, mass}, (double)time_increment, NULL, stick_force);
}

int32_t usub_stick_force_penalty_single(int32_t points, int32_t dimension,
                                        const float *previous_force, const float *slip_increment,
                                        const float *normal, const float *stiffness,
                                        float *stick_force) {
  return penalty(points, dimension, (reals){NULL, previous_force}, (reals){NULL, slip_increment},
                 (reals){NULL, normal}, (reals){NULL, stiffness}, NULL, stick_force);
}
