/* SPDX-License-Identifier: MIT */
/* The explicit drivers: VFRIC, VFRICTION and VFRIC_COEF.
 *
 * Local axes of a point: t1 along the slip increment, n the normal of the main surface, in three
 * dimensions t2 = n x t1. A step first computes the force of every point, block by block; only when
 * all blocks have succeeded are forces added to nodes and state kept, always in the order of the
 * points, so that the bits depend neither on threads nor on blocks. */
#include <stdio.h>
#include <string.h>

#include "axes.h"
#include "axes_wide.h"
#include "explicit.h"
#include "internal.h"

#define R double
#define SUFFIX(name) name##_d
#include "explicit_enforce.inc"
#include "explicit_motion.inc"

#include "explicit_block.inc"
#include "explicit_finish.inc"
#undef R
#undef SUFFIX
#define R float
#define SUFFIX(name) name##_f
#include "explicit_enforce.inc"
#include "explicit_motion.inc"

#include "explicit_block.inc"
#include "explicit_finish.inc"
#undef R
#undef SUFFIX

int32_t usub_explicit_block(usub_driver *driver, usub_call *call, int32_t index) {
  return driver->single ? block_f(driver, call, index) : block_d(driver, call, index);
}

/* Whether all numbers are from 1 to limit; one branch, so that it becomes wide instructions. */
static int are_within(const int32_t *nodes, size_t count, int32_t limit) {
  uint32_t outside = 0;
  for (size_t i = 0; i < count; ++i)
    outside |= (uint32_t)nodes[i] - 1 >= (uint32_t)limit;
  return !outside;
}

/* Refuses node numbers outside 1 ... limit, since they become addresses. */
static int32_t check_nodes(usub_driver *driver, const char *array, const int32_t *nodes,
                           size_t count, size_t per_point, int32_t limit) {
  if (!nodes || are_within(nodes, count, limit))
    return USUB_OK;
  size_t i = 0;
  while (nodes[i] >= 1 && nodes[i] <= limit)
    ++i;
  const int32_t point = (int32_t)(i / per_point);
  usub_fail(driver, USUB_BAD_INPUT, "%s: %s = %d at point %d; expected 1 to %d", driver->title,
            array, nodes[i], point, limit);
  driver->failed_point = point;
  return USUB_BAD_INPUT;
}

static int32_t check_all_nodes(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const int is_vfric = usub_is_vfric(driver);
  /* Without nodal arrays the numbers of general contact are the routine's affair. */
  if (!is_vfric && size->Z == 0)
    return USUB_OK;
  const size_t n = (size_t)driver->points, secondary = is_vfric ? 1 : (size_t)size->B;
  const size_t mains = driver->analytical && n > 1 ? 1 : n, main = (size_t)size->M;
  int32_t status = USUB_OK;
  if (driver->secondary_matters)
    status = check_nodes(driver, "secondary_node", driver->memory.secondary_node, n * secondary,
                         secondary, is_vfric ? size->X : size->Z);
  if (!status && driver->main_matters)
    status = check_nodes(driver, "main_node", driver->memory.main_node, mains * main, main,
                         is_vfric ? size->Y : size->Z);
  return status;
}

int32_t usub_step(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_start_call(driver);
  if (driver->kind != USUB_KIND_OF_EXPLICIT)
    return usub_fail(driver, USUB_WRONG_ORDER, "usub_step: %s is not in an explicit driver",
                     driver->title);
  if (!driver->clock.timed)
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: usub_set_time has to come before usub_step",
                     driver->title);
  int32_t status = usub_prepare(driver);
  if (!status)
    status = check_all_nodes(driver);
  if (!status)
    status = usub_check_whole_inputs(driver);
  if (!status && usub_needs_time(driver) && !(driver->clock.time[2] > 0))
    status = usub_fail(driver, USUB_BAD_INPUT,
                       "%s: the time increment is 0; kinematic enforcement and tangential damping "
                       "need one above 0",
                       driver->title);
  if (status)
    return status;
  usub_state_keep(driver);
  status = usub_run_blocks(driver);
  if (status < 0) {
    usub_state_restore(driver);
    return status;
  }
  if (driver->single)
    finish_f(driver);
  else
    finish_d(driver);
  driver->accepted = driver->clock;
  return USUB_OK;
}

double usub_elastic_energy(const usub_driver *driver) {
  if (!driver || driver->kind != USUB_KIND_OF_EXPLICIT || !usub_is_elastic(driver))
    return 0.0;
  return driver->single ? elastic_energy_f(driver) : elastic_energy_d(driver);
}

double usub_dissipation(const usub_driver *driver) {
  return driver ? driver->dissipation : 0.0;
}
