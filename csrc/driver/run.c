/* SPDX-License-Identifier: MIT */
/* Calling the routine: one block, and all blocks over the workers. */
#include "call.inc"

#include <stdio.h>
#include <string.h>

#include "internal.h"

typedef int32_t (*block_style)(void **argv);
typedef int32_t (*points_style)(void **argv, const int64_t *stride, const int32_t *points,
                                int32_t count, int32_t *done);

int32_t usub_call_routine(const usub_driver *driver, usub_call *call) {
  if (__builtin_expect(driver->checked, 0))
    return usub_checked_call(driver, call);
  return usub_call_entry(driver, call, call->argv);
}

int32_t usub_call_entry(const usub_driver *driver, usub_call *call, void **argv) {
  const usub_entry entry = driver->routine.entry;
  if (driver->routine.style == USUB_STYLE_BLOCK)
    return ((block_style)entry)(argv);
  if (driver->routine.style == USUB_STYLE_POINTS)
    return ((points_style)entry)(argv, driver->stride, &(int32_t){0}, 1, &call->done);
  switch (usub_interface_key(driver->face) * 2 + driver->single) {
  case USUB_INTERFACE_FRIC * 2:
    usub_call_fric_d(entry, argv);
    break;
  case USUB_INTERFACE_FRIC_COEF * 2:
    usub_call_fric_coef_d(entry, argv);
    break;
  case USUB_INTERFACE_FRIC_COEF_2022 * 2:
    usub_call_fric_coef_2022_d(entry, argv);
    break;
  case USUB_INTERFACE_VFRIC * 2:
    usub_call_vfric_d(entry, argv);
    break;
  case USUB_INTERFACE_VFRIC * 2 + 1:
    usub_call_vfric_f(entry, argv);
    break;
  case USUB_INTERFACE_VFRICTION * 2:
    usub_call_vfriction_d(entry, argv);
    break;
  case USUB_INTERFACE_VFRICTION * 2 + 1:
    usub_call_vfriction_f(entry, argv);
    break;
  case USUB_INTERFACE_VFRIC_COEF * 2:
    usub_call_vfric_coef_d(entry, argv);
    break;
  default:
    usub_call_vfric_coef_f(entry, argv);
  }
  return USUB_OK;
}

int32_t usub_call_listed(const usub_driver *driver, usub_call *call, const int32_t *points,
                         int32_t count) {
  const usub_entry entry = driver->routine.entry;
  if (driver->routine.style == USUB_STYLE_POINTS)
    return ((points_style)entry)(call->argv, driver->stride, points, count, &call->done);
  /* What moves from point to point is moved on from one to the next; with few branches, since a
   * processor foresees the routine's own by those before them. */
  struct {
    void **place;
    int64_t stride;
  } moving[USUB_MAX_ARGS];
  void *argv[USUB_MAX_ARGS];
  memcpy(argv, call->argv, (size_t)driver->face->count * sizeof *argv);
  int32_t moving_count = 0;
  for (int32_t i = 0; i < driver->face->count; ++i)
    if (driver->stride[i]) {
      moving[moving_count].place = &argv[i];
      moving[moving_count++].stride = driver->stride[i];
    }
  for (int32_t j = 0, at = 0; j < count; ++j) {
    const int64_t step = points[j] - at;
    at = points[j];
#pragma GCC unroll 8
    for (int32_t m = 0; m < moving_count; ++m)
      *moving[m].place = (char *)*moving[m].place + step * moving[m].stride;
    call->done = at;
    if (driver->routine.style == USUB_STYLE_FULL) {
      usub_call_fric_d(entry, argv);
      continue;
    }
    const int32_t status = ((block_style)entry)(argv);
    if (status < 0)
      return status;
  }
  return USUB_OK;
}

/* Says which property was meant, if a fault lies behind the last one. */
static int is_behind_props(const usub_driver *driver, uintptr_t fault, char reason[256]) {
  const uintptr_t first = (uintptr_t)driver->props;
  const uintptr_t end = (uintptr_t)driver->props_pages + driver->props_bytes;
  if (fault < first || fault >= end)
    return 0;
  const char *props = usub_interface_key(driver->face) == USUB_INTERFACE_FRIC ? "PROPS" : "props";
  snprintf(reason, 256, "a memory fault in %s(%zu), of which the scene has %d", props,
           (size_t)(fault - first) / driver->size.real + 1, driver->prop_count);
  return 1;
}

void usub_explain(const usub_driver *driver, const usub_guard *guard, char reason[256]) {
  const uintptr_t nothing = (uintptr_t)driver->nothing, fault = guard->fault;
  memcpy(reason, guard->reason, sizeof guard->reason);
  if (!fault || is_behind_props(driver, fault, reason) || fault < nothing)
    return;
  const size_t position = (fault - nothing) / driver->nothing_place;
  if (position >= (size_t)driver->face->count)
    return;
  snprintf(reason, 256, "a memory fault in %s, which is not there (%s)",
           driver->face->args[position].modern, driver->sources[position].why);
}

__attribute__((noinline)) int32_t usub_call_guarded(const usub_driver *driver, usub_call *call,
                                                    char reason[256]) {
  USUB_ENDS_EXCEPTIONS;
  usub_guard guard;
  volatile int32_t status = USUB_OK;
  usub_guard_push(&guard);
  guard.single = driver->single;
  if (sigsetjmp(guard.env, 0) == 0) {
    status = usub_call_routine(driver, call);
    if (status < 0)
      strcpy(reason, status == USUB_ROUTINE_RAISED ? "an exception" : "its status");
  } else {
    status = guard.status;
    usub_explain(driver, &guard, reason);
  }
  usub_guard_pop(&guard);
  return status;
}

int32_t usub_ended(usub_driver *driver, usub_call *call, int32_t index, int32_t first,
                   int32_t status, const char *reason) {
  const int32_t seen = usub_checked_fail(driver, call, index, first, status);
  if (seen)
    return seen;
  if (call->n == 0)
    return usub_block_fail(driver, call, index, -1, status,
                           "%s: the routine ended with %s in a call without points", driver->title,
                           reason);
  const int32_t last = first + usub_point_at(call, call->n - 1);
  first += usub_point_at(call, 0);
  if (call->n == 1)
    return usub_block_fail(driver, call, index, first, status,
                           "%s: the routine ended with %s at point %d", driver->title, reason,
                           first);
  return usub_block_fail(driver, call, index, -1, status,
                         "%s: the routine ended with %s in points %d to %d", driver->title, reason,
                         first, last);
}

usub_block_fn usub_block_of(const usub_driver *driver) {
  static const usub_block_fn blocks[] = {usub_standard_block, usub_explicit_block,
                                         usub_coefficient_block};
  return blocks[driver->kind];
}

static void task(void *context, int32_t worker, int32_t index) {
  usub_driver *driver = context;
  /* Blocks behind a failed one are of no use; those before it may hold the first failure. */
  if (index > atomic_load_explicit(&driver->first_failed, memory_order_relaxed))
    return;
  usub_block_of(driver)(driver, &driver->calls[worker], index);
}

int32_t usub_run_blocks(usub_driver *driver) {
  const usub_block_fn block = usub_block_of(driver);
  const int32_t count = driver->points / driver->block + (driver->points % driver->block != 0);
  atomic_store_explicit(&driver->first_failed, INT32_MAX, memory_order_relaxed);
  for (int32_t w = 0; w < driver->threads; ++w)
    driver->calls[w].status = USUB_OK;
  if (driver->checked)
    usub_checked_start(driver);
  if (driver->pool && count > 1) {
    usub_pool_run(driver->pool, task, driver, count);
  } else {
    for (int32_t index = 0; index < count; ++index)
      if (block(driver, &driver->calls[0], index) < 0)
        break;
  }
  const int32_t failed = atomic_load(&driver->first_failed);
  if (failed == INT32_MAX)
    return USUB_OK;
  for (int32_t w = 0; w < driver->threads; ++w) {
    const usub_call *call = &driver->calls[w];
    if (!call->status || call->failed_block != failed)
      continue;
    driver->failed_block = failed;
    driver->failed_point = call->failed_point;
    snprintf(driver->message, sizeof driver->message, "%s", call->message);
    return call->status;
  }
  return USUB_CONTRACT;
}
