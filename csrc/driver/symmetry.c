/* SPDX-License-Identifier: MIT */
/* What a symmetric solver would lose of the tangents of a standard driver. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "axes.h"
#include "standard.h"

/* Parts below this are rounding of tangents that are symmetric. */
#define ROUNDING 1e-12
/* Above this coefficient the commercial solver is assumed to choose its unsymmetric solver. */
#define SWITCHES_AT 0.2

/* Size of the skew part of the derivative by the slip over the size of the derivative. */
static double skew_of(const usub_driver *driver, const double *tangent) {
  if (driver->size.F < 2)
    return 0;
  const double across = 0.5 * (tangent[2] - tangent[1]); /* column-major */
  const double size =
      usub_norm2_d(usub_norm2_d(tangent[0], tangent[1]), usub_norm2_d(tangent[2], tangent[3]));
  return size > 0 ? sqrt(2) * fabs(across) / size : 0;
}

static void write_sentence(usub_symmetry *found) {
  const size_t size = sizeof found->sentence;
  if (!found->unsymmetric_points) {
    snprintf(found->sentence, size, "symmetric: a symmetric solver loses nothing");
    return;
  }
  int used = snprintf(found->sentence, size, "unsymmetric at %d of %d closed points",
                      found->unsymmetric_points, found->closed_points);
  if (found->skew > ROUNDING)
    used += snprintf(found->sentence + used, size - (size_t)used,
                     "; d tau/d gamma has a skew part of up to %.3g of it (point %d)", found->skew,
                     found->skew_point);
  if (found->pressure > ROUNDING)
    used += snprintf(found->sentence + used, size - (size_t)used,
                     "; d tau/d p, which has no counterpart, is up to %.3g (point %d)",
                     found->pressure, found->pressure_point);
  snprintf(found->sentence + used, size - (size_t)used,
           ": a symmetric solver leaves that out and converges linearly to the same answer, or not "
           "at all%s",
           found->solver_switches ? "; the commercial solver is assumed to choose its unsymmetric "
                                    "one (mu above 0.2, or dependent on pressure)"
                                  : "");
}

/* Adds one point to the summary. */
static void look_at(const usub_driver *driver, const usub_point_arrays *at, int32_t p,
                    double parts[2], usub_symmetry *found) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  parts[0] = parts[1] = 0;
  found->closed_points += driver->last.closed[p];
  if (!driver->last.closed[p] || at->lm[p] != USUB_SLIPPING)
    return;
  parts[0] = skew_of(driver, at->ddtddg + i * F * F);
  parts[1] = usub_norm2_d(at->ddtddp[i * F], F == 2 ? at->ddtddp[i * F + 1] : 0);
  if (parts[0] > found->skew) {
    found->skew = parts[0];
    found->skew_point = p;
  }
  if (parts[1] > found->pressure) {
    found->pressure = parts[1];
    found->pressure_point = p;
  }
  found->unsymmetric_points += parts[0] > ROUNDING || parts[1] > ROUNDING;
  found->solver_switches |= parts[1] > SWITCHES_AT;
  if (!usub_is_fric(driver))
    found->solver_switches |=
        driver->last.by_pressure[p] ||
        fmax(at->coefficient[2 * i], at->coefficient[2 * i + 1]) > SWITCHES_AT;
}

int32_t usub_find_symmetry(usub_driver *driver, double *skew, double *pressure,
                           usub_symmetry *found) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_start_call(driver);
  if (driver->kind != USUB_KIND_OF_STANDARD)
    return usub_fail(driver, USUB_WRONG_ORDER, "usub_find_symmetry: %s is not in a standard driver",
                     driver->title);
  if (!driver->set.tangent)
    return usub_fail(driver, USUB_NOT_SUPPORTED,
                     "%s: the scene setting 'tangent' is 0, so that there is no tangent to look at",
                     driver->title);
  if (!driver->last.complete)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: usub_find_symmetry needs a usub_iterate before it, and the last one "
                     "failed or never was",
                     driver->title);
  const usub_point_arrays at = usub_point_arrays_of(driver);
  usub_symmetry sum = {.skew_point = -1, .pressure_point = -1};
  for (int32_t p = 0; p < driver->points; ++p) {
    double parts[2];
    look_at(driver, &at, p, parts, &sum);
    if (skew)
      skew[p] = parts[0];
    if (pressure)
      pressure[p] = parts[1];
  }
  write_sentence(&sum);
  if (found)
    *found = sum;
  return USUB_OK;
}
