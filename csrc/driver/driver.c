/* SPDX-License-Identifier: MIT */
/* The calls that all kinds of drivers have in common. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "internal.h"

int32_t usub_set_points(usub_driver *driver, int32_t points) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  if (points < 0 || points > driver->size.N)
    return usub_fail(driver, USUB_BAD_ARGUMENT, "%s: %d points; expected 0 to %d", driver->title,
                     points, driver->size.N);
  if (driver->last.open)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: the number of points cannot change while an increment is open",
                     driver->title);
  usub_start_call(driver);
  driver->points = points;
  return USUB_OK;
}

/* Whether a number keeps its meaning in the precision of the scene: neither infinite nor, unless it
 * was, zero. */
static int survives(const usub_driver *driver, double value) {
  if (!isfinite(value))
    return 0;
  if (!driver->single || value == 0)
    return 1;
  return fabs(value) <= (double)FLT_MAX && (float)value != 0;
}

int32_t usub_set_time(usub_driver *driver, int32_t step, int32_t increment, double step_time,
                      double total_time, double time_increment) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  if (driver->last.open)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: the time cannot change while an increment is open; commit or cut back",
                     driver->title);
  if (!(time_increment >= 0) || !survives(driver, time_increment) || !survives(driver, step_time) ||
      !survives(driver, total_time))
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: step time %g, total time %g, time increment %g; expected finite values "
                     "of %s precision and an increment of 0 or more",
                     driver->title, step_time, total_time, time_increment, driver->set.precision);
  usub_start_call(driver);
  usub_clock *clock = &driver->clock;
  clock->flags[0] = step;
  clock->flags[1] = increment;
  const double times[3] = {step_time, total_time, time_increment};
  for (int i = 0; i < 3; ++i) {
    clock->time[i] = times[i];
    clock->time_f[i] = (float)times[i];
  }
  driver->clock.timed = 1;
  return USUB_OK;
}

int32_t usub_get_time(const usub_driver *driver, int32_t *numbers, double *times) {
  if (!driver || !numbers || !times)
    return USUB_BAD_ARGUMENT;
  memcpy(numbers, driver->clock.flags, 2 * sizeof *numbers);
  memcpy(times, driver->clock.time, 3 * sizeof *times);
  return USUB_OK;
}

int32_t usub_set_friction_work(usub_driver *driver, double work) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  if (!isfinite(work) || (driver->single && fabs(work) > (double)FLT_MAX))
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: friction work %g; expected a finite value of %s precision", driver->title,
                     work, driver->set.precision);
  usub_start_call(driver);
  driver->clock.time[3] = work;
  driver->clock.time_f[3] = (float)work;
  return USUB_OK;
}

/* Whether the block that failed can be run again: the host may have changed arrays or points. */
static int can_replay(const usub_driver *driver) {
  return driver->failed_block >= 0 && driver->prepared && driver->aimed &&
         driver->failed_block <= (driver->points - 1) / driver->block;
}

int32_t usub_replay(usub_driver *driver, usub_entry entry) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  if (!entry)
    return usub_fail(driver, USUB_BAD_ARGUMENT, "%s: the entry to replay is NULL", driver->title);
  if (!can_replay(driver))
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: no block has failed", driver->title);
  /* One block with the twin in place of the routine; then everything is put back. */
  const usub_routine kept = driver->routine;
  const int32_t checked = driver->checked;
  usub_state_keep(driver);
  driver->checked = 0;
  driver->routine.entry = entry;
  driver->routine.style = USUB_STYLE_BLOCK;
  driver->calls[0].status = USUB_OK;
  atomic_store(&driver->first_failed, INT32_MAX);
  const int32_t status = usub_block_of(driver)(driver, &driver->calls[0], driver->failed_block);
  driver->routine = kept;
  driver->checked = checked;
  usub_state_restore(driver);
  return status;
}

int32_t usub_empty(usub_driver *driver) {
  return driver ? USUB_OK : USUB_BAD_ARGUMENT;
}

const char *usub_release(void) {
  return USUB_RELEASE;
}
