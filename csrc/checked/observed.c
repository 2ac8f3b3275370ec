/* SPDX-License-Identifier: MIT */
/* What a host asks of a checked driver. */
#include <math.h>
#include <string.h>

#include "../driver/explicit.h"
#include "checked.h"

void usub_checked_start(usub_driver *driver) {
  for (int32_t w = 0; w < driver->threads; ++w) {
    usub_checker *checker = driver->calls[w].checker;
    if (!checker)
      continue;
    memset(&checker->seen, 0, sizeof checker->seen);
    checker->seen.argument = checker->seen.point = -1;
    checker->seen.element = -1;
  }
}

/* What the worker saw whose failure the driver reports: that of the lowest block. */
int32_t usub_get_observed(const usub_driver *driver, usub_observed *observed) {
  if (!driver || !observed)
    return USUB_BAD_ARGUMENT;
  memset(observed, 0, sizeof *observed);
  observed->argument = observed->point = -1;
  observed->element = -1;
  if (!driver->checked)
    return USUB_WRONG_ORDER;
  usub_observed sum = *observed;
  int32_t lowest = INT32_MAX;
  for (int32_t w = 0; driver->calls && w < driver->threads; ++w) {
    const usub_call *call = &driver->calls[w];
    if (!call->checker)
      continue;
    const usub_observed *seen = &call->checker->seen;
    if (seen->status && call->status && call->failed_block < lowest) {
      *observed = *seen;
      lowest = call->failed_block;
    }
    sum.flags |= seen->flags;
    sum.unwritten |= seen->unwritten;
    sum.read |= seen->read;
    sum.written |= seen->written;
  }
  observed->flags = sum.flags;
  observed->unwritten = sum.unwritten;
  observed->read = sum.read;
  observed->written = sum.written;
  return USUB_OK;
}

int32_t usub_set_time_limit(usub_driver *driver, double seconds) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  if (!(seconds >= 0) || !isfinite(seconds))
    return usub_fail(driver, USUB_BAD_ARGUMENT,
                     "%s: time limit of %g s; expected a finite value, 0 for none", driver->title,
                     seconds);
  driver->time_limit = seconds;
  return USUB_OK;
}

int32_t usub_trace(usub_driver *driver, int32_t on) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  if (on && !driver->checked)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: tracing needs a checked driver; set the scene's 'checked' to 1",
                     driver->title);
  driver->tracing = on != 0;
  return USUB_OK;
}

int32_t usub_call_empty_block(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  usub_start_call(driver);
  if (driver->kind == USUB_KIND_OF_STANDARD)
    return usub_fail(driver, USUB_NOT_SUPPORTED,
                     "%s: a standard host calls it for points that are there", driver->title);
  int32_t status = usub_prepare(driver);
  if (status)
    return status;
  usub_call *call = &driver->calls[0];
  char reason[256] = "";
  if (driver->checked)
    usub_checked_start(driver);
  for (int32_t w = 0; w < driver->threads; ++w)
    driver->calls[w].status = USUB_OK;
  atomic_store(&driver->first_failed, INT32_MAX);
  usub_state_keep(driver);
  usub_aim(driver, call, 0, 0);
  status = usub_call_guarded(driver, call, reason);
  usub_state_restore(driver);
  if (status >= 0)
    return USUB_OK;
  status = usub_ended(driver, call, 0, 0, status, reason);
  driver->failed_point = call->failed_point;
  driver->failed_block = call->failed_block;
  memcpy(driver->message, call->message, sizeof call->message);
  return status;
}
