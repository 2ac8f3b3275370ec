/* SPDX-License-Identifier: MIT */
/* Changing friction: what a step starts from.
 *
 * The values of the last committed increment are kept at every point. Those a step starts from are
 * they, until its first increment is committed, which freezes them: no call but usub_commit changes
 * them. A point keeps its last coefficient while it is open. */
#include <string.h>

#include "standard.h"

/* Whether no increment of the step of now has been committed. */
static int is_new_step(const usub_driver *driver) {
  return !driver->accepted.timed || driver->accepted.flags[0] != driver->clock.flags[0];
}

const double *usub_start_coefficient(const usub_driver *driver, const usub_point_arrays *at,
                                     int32_t p) {
  return (is_new_step(driver) ? at->committed_coefficient : at->start_coefficient) + 2 * (size_t)p;
}

double usub_allowable_elastic_slip(const usub_driver *driver, const usub_point_arrays *at,
                                   int32_t p) {
  const double end = usub_critical_elastic_slip(&driver->set), by = driver->amplitude;
  if (driver->set.changing != 1)
    return end;
  const double start = (is_new_step(driver) ? at->committed_allowable : at->start_allowable)[p];
  return start > 0 && end > 0 ? (1 - by) * start + by * end : end;
}

void usub_commit_changing(usub_driver *driver, const usub_point_arrays *at) {
  const usub_iteration *last = &driver->last;
  const size_t N = (size_t)driver->size.N, n = (size_t)driver->points;
  if (is_new_step(driver)) {
    memcpy(at->start_coefficient, at->committed_coefficient, 2 * N * sizeof(double));
    memcpy(at->start_allowable, at->committed_allowable, N * sizeof(double));
  }
  for (size_t i = 0; i < n; ++i)
    if (last->closed[i])
      memcpy(at->committed_coefficient + 2 * i, last->coefficient + 2 * i, 2 * sizeof(double));
  for (size_t i = 0; i < N; ++i)
    at->committed_allowable[i] = usub_allowable_elastic_slip(driver, at, (int32_t)i);
}
