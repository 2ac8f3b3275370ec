/* SPDX-License-Identifier: MIT */
/* The calls of a standard driver: begin, iterate, commit, cut back. */
#include <string.h>

#include "standard.h"

static int32_t check_order(usub_driver *driver, const char *call, int open) {
  usub_start_call(driver);
  if (driver->kind != USUB_KIND_OF_STANDARD)
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: %s is not in a standard driver", call,
                     driver->title);
  if (driver->last.open != open)
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: %s %s", driver->title, call,
                     open ? "needs usub_begin_increment before it"
                          : "came while an increment is open; commit or cut back first");
  return USUB_OK;
}

int32_t usub_begin_increment(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  const int32_t status = check_order(driver, "usub_begin_increment", 0);
  if (status)
    return status;
  if (!driver->clock.timed)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: usub_set_time has to come before usub_begin_increment", driver->title);
  driver->last.open = 1;
  driver->last.done = driver->last.complete = 0;
  driver->last.pnewdt = USUB_PNEWDT_PRESET;
  driver->clock.iteration = 0;
  return USUB_OK;
}

/* Copies what the next iteration and a commit need of an iteration that has succeeded. */
static void keep_iteration(usub_driver *driver) {
  const usub_point_arrays at = usub_point_arrays_of(driver);
  usub_iteration *last = &driver->last;
  const size_t n = (size_t)driver->points, vector = n * (size_t)driver->size.F * sizeof(double);
  memcpy(last->lm, at.lm, n * sizeof *last->lm);
  memcpy(last->closed, last->trial_closed, n);
  memcpy(last->dslip, at.dslip, vector);
  memcpy(last->tau, at.tau, vector);
  memcpy(last->sed, at.sed, n * sizeof(double));
  if (at.coefficient)
    memcpy(last->coefficient, at.coefficient, 2 * n * sizeof(double));
  usub_choose(n, last->pressure, at.pressure, last->closed); /* whatever the host has there */
  last->done = last->complete = 1;
  last->pnewdt = USUB_PNEWDT_PRESET;
  for (int32_t w = 0; w < driver->threads; ++w)
    if (driver->calls[w].pnewdt < last->pnewdt)
      last->pnewdt = driver->calls[w].pnewdt;
}

int32_t usub_iterate(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  int32_t status = check_order(driver, "usub_iterate", 1);
  if (!status)
    status = usub_prepare(driver);
  if (status)
    return status;
  for (int32_t w = 0; w < driver->threads; ++w)
    driver->calls[w].pnewdt = USUB_PNEWDT_PRESET;
  driver->last.complete = 0;
  driver->clock.iteration += 1;
  status = usub_run_blocks(driver);
  if (status < 0) {
    driver->clock.iteration -= 1;
    return status;
  }
  keep_iteration(driver);
  return driver->last.pnewdt < 1 ? USUB_CUT_BACK : USUB_OK;
}

/* What the point was in the increment that ends: closed and frictionless counts as slipping. */
static int32_t condition_of(const usub_iteration *last, size_t i) {
  if (!last->closed[i])
    return USUB_OPEN;
  return last->lm[i] == 1 ? USUB_STICKING : USUB_SLIPPING;
}

/* Points that are not there are open: they carry no stress, and their state waits for them. */
static void open_absent_points(usub_driver *driver, const usub_point_arrays *at) {
  const size_t n = (size_t)driver->points, N = (size_t)driver->size.N, F = (size_t)driver->size.F;
  for (size_t i = n; i < N; ++i)
    at->condition[i] = USUB_OPEN;
  memset(at->committed_tau + n * F, 0, (N - n) * F * sizeof(double));
  memset(at->committed_sed + n, 0, (N - n) * sizeof(double));
  memset(at->committed_pressure + n, 0, (N - n) * sizeof(double));
  if (at->elastic_slip)
    memset(at->elastic_slip + n * F, 0, (N - n) * F * sizeof(double));
}

int32_t usub_commit(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  const int32_t status = check_order(driver, "usub_commit", 1);
  if (status)
    return status;
  usub_iteration *last = &driver->last;
  if (!last->complete)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: usub_commit needs a usub_iterate before it, and the last one failed or "
                     "never was",
                     driver->title);
  const usub_point_arrays at = usub_point_arrays_of(driver);
  const size_t n = (size_t)driver->points, F = (size_t)driver->size.F, S = (size_t)driver->size.S;
  for (size_t i = 0; i < n * F; ++i)
    at.slip[i] += last->dslip[i];
  for (size_t i = 0; i < n; ++i)
    at.condition[i] = condition_of(last, i);
  memcpy(at.committed_tau, last->tau, n * F * sizeof(double));
  memcpy(at.committed_sed, last->sed, n * sizeof(double));
  memcpy(at.committed_pressure, last->pressure, n * sizeof(double));
  if (S)
    memcpy(at.state, last->trial_state, n * S * sizeof(double));
  if (at.elastic_slip) {
    memcpy(at.elastic_slip, last->trial_elastic, n * F * sizeof(double));
    memcpy(at.equivalent_slip, last->trial_equivalent, n * sizeof(double));
    usub_commit_changing(driver, &at);
  }
  open_absent_points(driver, &at);
  last->open = 0;
  driver->accepted = driver->clock;
  return USUB_OK;
}

int32_t usub_cut_back(usub_driver *driver) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  const int32_t status = check_order(driver, "usub_cut_back", 1);
  if (status)
    return status;
  driver->last.open = 0;
  return USUB_OK;
}

int32_t usub_set_amplitude(usub_driver *driver, double amplitude) {
  if (!driver)
    return USUB_BAD_ARGUMENT;
  const int32_t status = check_order(driver, "usub_set_amplitude", 0);
  if (status)
    return status;
  if (!driver->set.changing)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: an amplitude needs the scene setting 'changing'", driver->title);
  if (!(amplitude >= 0 && amplitude <= 1))
    return usub_fail(driver, USUB_BAD_ARGUMENT, "%s: amplitude %g; expected 0 to 1", driver->title,
                     amplitude);
  driver->amplitude = amplitude;
  return USUB_OK;
}

double usub_pnewdt(const usub_driver *driver) {
  return driver && driver->kind == USUB_KIND_OF_STANDARD ? driver->last.pnewdt : USUB_PNEWDT_PRESET;
}
