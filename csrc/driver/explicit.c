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
#include "explicit.h"
#include "internal.h"

#define R double
#define SUFFIX(name) name##_d
#include "explicit_block.inc"
#undef R
#undef SUFFIX
#define R float
#define SUFFIX(name) name##_f
#include "explicit_block.inc"
#undef R
#undef SUFFIX

int32_t usub_explicit_block(usub_driver *driver, usub_call *call, int32_t index) {
  return driver->single ? block_f(driver, call, index) : block_d(driver, call, index);
}

/* Refuses node numbers outside 1 ... limit: they become addresses. */
static int32_t check_nodes(usub_driver *driver, const char *array, int32_t limit) {
  const usub_slot *slot = usub_slot_find(driver, array);
  if (!slot || !slot->data || limit == 0) return USUB_OK;
  const size_t per_point = slot->per_point ? slot->per_point : slot->count;
  const size_t count = slot->per_point ? per_point * (size_t)driver->points : slot->count;
  const int32_t *nodes = slot->data;
  for (size_t i = 0; i < count; ++i) {
    if (nodes[i] >= 1 && nodes[i] <= limit) continue;
    driver->failed_point = (int32_t)(i / (per_point ? per_point : 1));
    return usub_fail(driver, USUB_BAD_INPUT, "%s: %s = %d at point %d; expected 1 to %d",
                     driver->title, array, nodes[i], driver->failed_point, limit);
  }
  return USUB_OK;
}

int32_t usub_step(usub_driver *driver) {
  if (!driver) return USUB_BAD_ARGUMENT;
  driver->failed_point = -1;
  driver->message[0] = 0;
  if (driver->kind != USUB_KIND_OF_EXPLICIT)
    return usub_fail(driver, USUB_WRONG_ORDER, "usub_step: %s is not in an explicit driver",
                     driver->title);
  if (!driver->timed)
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: usub_set_time has to come before usub_step",
                     driver->title);
  int32_t status = usub_prepare(driver);
  if (status) return status;
  const int is_vfric = usub_interface_key(driver->face) == USUB_INTERFACE_VFRIC;
  status = check_nodes(driver, "secondary_node", is_vfric ? driver->size.X : driver->size.Z);
  if (!status) status = check_nodes(driver, "main_node", is_vfric ? driver->size.Y : driver->size.Z);
  if (status) return status;
  const usub_slot *state = usub_slot_find(driver, "state");
  const size_t state_bytes = state ? state->count * state->element : 0;
  if (state_bytes) memcpy(driver->state_backup, state->data, state_bytes);
  status = usub_run_blocks(driver, usub_explicit_block);
  if (status < 0) {
    if (state_bytes) memcpy(state->data, driver->state_backup, state_bytes);
    return status;
  }
  if (driver->single)
    finish_f(driver);
  else
    finish_d(driver);
  driver->accepted = driver->clock;
  return USUB_OK;
}

double usub_dissipation(const usub_driver *driver) { return driver ? driver->dissipation : 0.0; }
