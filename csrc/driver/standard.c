/* SPDX-License-Identifier: MIT */
/* The standard drivers: increments, iterations, committed and trial state.
 *
 * Committed values live in slots of role "state" and change in usub_commit alone. An iteration
 * writes the slots of role "out" and trial memory; what the next iteration and a commit need of it
 * is copied only if the whole iteration succeeds (usub_iteration). */
#include <stdlib.h>
#include <string.h>

#include "standard.h"

int32_t usub_standard_create(usub_driver *driver) {
  const size_t N = (size_t)driver->size.N, F = (size_t)driver->size.F, S = (size_t)driver->size.S;
  usub_iteration *last = &driver->last;
  last->lm = calloc(N, sizeof *last->lm);
  last->closed = calloc(N, 1);
  last->trial_closed = calloc(N, 1);
  last->dslip = calloc(N * F, sizeof(double));
  last->tau = calloc(N * F, sizeof(double));
  last->sed = calloc(N, sizeof(double));
  last->pressure = calloc(N, sizeof(double));
  if (S)
    last->trial_state = calloc(N * S, sizeof(double));
  if (!last->lm || !last->closed || !last->trial_closed || !last->dslip || !last->tau ||
      !last->sed || !last->pressure || (S && !last->trial_state))
    return USUB_NO_MEMORY;
  if (!usub_is_fric(driver)) {
    last->trial_elastic = calloc(N * F, sizeof(double));
    last->trial_equivalent = calloc(N, sizeof(double));
    last->coefficient = calloc(2 * N, sizeof(double));
    last->by_pressure = calloc(N, 1);
    if (!last->trial_elastic || !last->trial_equivalent || !last->coefficient || !last->by_pressure)
      return USUB_NO_MEMORY;
  }
  int32_t *condition = driver->memory.condition;
  for (size_t i = 0; i < N; ++i)
    condition[i] = USUB_OPEN; /* nothing was closed before the first increment */
  last->pnewdt = USUB_PNEWDT_PRESET;
  driver->amplitude = 1;
  return USUB_OK;
}

void usub_standard_free(usub_driver *driver) {
  usub_iteration *last = &driver->last;
  free(last->lm);
  free(last->closed);
  free(last->trial_closed);
  free(last->dslip);
  free(last->tau);
  free(last->sed);
  free(last->pressure);
  free(last->trial_state);
  free(last->trial_elastic);
  free(last->trial_equivalent);
  free(last->coefficient);
  free(last->by_pressure);
}

void usub_standard_plan(usub_driver *driver) {
  if (usub_is_fric(driver))
    usub_fric_plan(driver);
  else
    usub_fric_coef_plan(driver);
}

usub_point_arrays usub_point_arrays_of(const usub_driver *driver) {
  const usub_memory *memory = &driver->memory;
  return (usub_point_arrays){
      .lm = memory->lm,
      .condition = memory->condition,
      .closed = memory->closed,
      .node = memory->node,
      .tau = memory->tau,
      .ddtddg = memory->ddtddg,
      .ddtddp = memory->ddtddp,
      .ddtddt = memory->ddtddt,
      .dslip = memory->dslip,
      .sed = memory->sed,
      .sfd = memory->sfd,
      .slip = memory->slip,
      .state = memory->state,
      .committed_tau = memory->committed_tau,
      .committed_sed = memory->committed_sed,
      .committed_pressure = memory->committed_pressure,
      .slip_increment = memory->slip_increment,
      .pressure = memory->pressure,
      .multiplier = memory->multiplier,
      .rotation = memory->rotation,
      .temperature = {memory->temperature_secondary, memory->temperature_main},
      .field = {memory->field_secondary, memory->field_main},
      .elastic_slip = memory->elastic_slip,
      .equivalent_slip = memory->equivalent_slip,
      .coefficient = memory->coefficient,
      .committed_coefficient = memory->committed_coefficient,
      .start_coefficient = memory->start_coefficient,
      .committed_allowable = memory->committed_allowable,
      .start_allowable = memory->start_allowable,
  };
}

void usub_clear_slip_and_tangent(const usub_point_arrays *at, int32_t directions, int32_t p) {
  const size_t F = (size_t)directions, i = (size_t)p;
  memset(at->dslip + i * F, 0, F * sizeof(double));
  if (at->ddtddg)
    memset(at->ddtddg + i * F * F, 0, F * F * sizeof(double));
  if (at->ddtddp)
    memset(at->ddtddp + i * F, 0, F * sizeof(double));
  if (at->ddtddt)
    memset(at->ddtddt + i * F * 2, 0, F * 2 * sizeof(double));
}

/* Clears what a point returns; committed values where the rules ask for them. */
static void reset_point(usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const size_t F = (size_t)driver->size.F, S = (size_t)driver->size.S, i = (size_t)p;
  memset(at->tau + i * F, 0, F * sizeof(double));
  usub_clear_slip_and_tangent(at, driver->size.F, p);
  at->sed[i] = at->sfd[i] = 0;
  if (S)
    memcpy(driver->last.trial_state + i * S, at->state + i * S, S * sizeof(double));
}

/* Refuses NaN and infinity. */
static int32_t look_at_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                             int32_t index, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  const double pressure = at->pressure[i];
  if (!(pressure - pressure == 0))
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "%s: pressure[%d] = %g; expected a finite value", driver->title, p,
                           pressure);
  const int32_t bad = usub_first_bad_of_few(at->slip_increment + i * F, driver->size.F);
  if (bad >= 0)
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "%s: slip_increment of point %d, direction %d, = %g; expected a finite "
                           "value",
                           driver->title, p, bad + 1, at->slip_increment[i * F + (size_t)bad]);
  return USUB_OK;
}

/* Point `p`. */
static int32_t run_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                         int32_t index, int32_t p) {
  const int32_t status = look_at_point(driver, call, at, index, p);
  if (status)
    return status;
  reset_point(driver, at, p);
  driver->last.trial_closed[p] = (unsigned char)usub_is_closed(at, p);
  if (!driver->last.trial_closed[p]) {
    at->lm[p] = USUB_OPEN;
    if (!usub_is_fric(driver))
      usub_fric_coef_open_point(driver, at, p);
    return USUB_OK;
  }
  return usub_is_fric(driver) ? usub_fric_point(driver, call, at, index, p)
                              : usub_fric_coef_point(driver, call, at, index, p);
}

int32_t usub_check_answers(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p, const char *how) {
  const int32_t F = driver->size.F;
  const size_t i = (size_t)p, f = (size_t)F;
  const struct {
    const char *name;
    const double *data;
    int32_t count;
  } outputs[] = {{"TAU", at->tau + i * f, F},
                 {"DDTDDG", at->ddtddg ? at->ddtddg + i * f * f : NULL, F * F},
                 {"DDTDDP", at->ddtddp ? at->ddtddp + i * f : NULL, F},
                 {"DDTDDT", at->ddtddt ? at->ddtddt + i * f * 2 : NULL, F * 2},
                 {"DSLIP", at->dslip + i * f, F},
                 {"SED", at->sed + i, 1},
                 {"SFD", at->sfd + i, 1}};
  for (size_t o = 0; o < sizeof outputs / sizeof outputs[0]; ++o) {
    const int32_t bad =
        outputs[o].data ? usub_first_bad_of_few(outputs[o].data, outputs[o].count) : -1;
    if (bad >= 0)
      return usub_block_fail(driver, call, index, p, USUB_NOT_FINITE,
                             "%s: %s %s, element %d = %g, at point %d", driver->title, how,
                             outputs[o].name, bad + 1, outputs[o].data[bad], p);
  }
  return USUB_OK;
}

int32_t usub_check_trial_state(usub_driver *driver, usub_call *call, int32_t index, int32_t p) {
  const int32_t S = driver->size.S;
  if (!S)
    return USUB_OK;
  const double *state = driver->last.trial_state + (size_t)p * (size_t)S;
  const int32_t bad = usub_first_bad_of_few(state, S);
  if (bad < 0)
    return USUB_OK;
  return usub_block_fail(driver, call, index, p, USUB_NOT_FINITE,
                         "%s: the routine left state variable %d = %g at point %d", driver->title,
                         bad + 1, state[bad], p);
}

/* Points from *p to `last`, where *p always is the first of the call that is going on. */
static int32_t run_points(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                          int32_t index, volatile int32_t *p, int32_t last) {
  const int32_t most = usub_points_a_call(driver);
  for (int32_t status = USUB_OK; *p < last;) {
    const int32_t left = last - *p, count = left < most ? left : most;
    if (most > 1) {
      status = usub_fric_together(driver, call, at, index, *p, count);
      if (status != USUB_ONE_BY_ONE) {
        if (status < 0)
          return status;
        *p += count;
        continue;
      }
    }
    for (const int32_t end = *p + count; *p < end; ++*p) {
      status = run_point(driver, call, at, index, *p);
      if (status < 0)
        return status;
    }
  }
  return USUB_OK;
}

/* One guard for all points of the block: arming it costs as much as a cheap routine. */
__attribute__((noinline)) int32_t usub_standard_block(usub_driver *driver, usub_call *call,
                                                      int32_t index) {
  USUB_ENDS_EXCEPTIONS;
  const usub_point_arrays at = usub_point_arrays_of(driver);
  const int32_t first = index * driver->block, rest = driver->points - first;
  const int32_t last = first + (rest < driver->block ? rest : driver->block);
  volatile int32_t p = first;
  volatile int32_t status = USUB_OK;
  usub_guard guard;
  usub_guard_push(&guard);
  if (sigsetjmp(guard.env, 0) == 0) {
    status = run_points(driver, call, &at, index, &p, last);
  } else {
    char reason[256];
    usub_explain(driver, &guard, reason);
    status = usub_fric_ended(driver, call, &at, index, p, guard.status, reason);
  }
  usub_guard_pop(&guard);
  return status;
}
