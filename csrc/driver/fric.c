/* SPDX-License-Identifier: MIT */
/* One point of FRIC: what goes in, and what the answer means. */
#include <string.h>

#include "standard.h"

/* LM on entry: the routine's own of the last iteration, or the condition of the last increment. */
static int32_t lm_on_entry(const usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const usub_iteration *last = &driver->last;
  return last->done && last->closed[p] ? last->lm[p] : at->condition[p];
}

/* What the routine continues from. */
static void fill_answers(usub_driver *driver, const usub_call *call, const usub_point_arrays *at,
                         int32_t p, int32_t lm) {
  const usub_iteration *last = &driver->last;
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  at->lm[i] = lm;
  memcpy(at->tau + i * F, at->committed_tau + i * F, F * sizeof(double));
  at->sed[i] = at->committed_sed[i];
  if (last->done && last->closed[p] && lm == 0)
    memcpy(at->dslip + i * F, last->dslip + i * F, F * sizeof(double));
  /* Tangents that the host wants were cleared with the point. */
  if (usub_is_live(driver, USUB_FRIC_DDTDDG))
    memset(call->argv[USUB_FRIC_DDTDDG], 0, F * F * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_DDTDDP))
    memset(call->argv[USUB_FRIC_DDTDDP], 0, F * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_DDTDDT))
    memset(call->argv[USUB_FRIC_DDTDDT], 0, F * 2 * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_PNEWDT))
    *(double *)call->argv[USUB_FRIC_PNEWDT] = USUB_PNEWDT_PRESET;
}

/* What the routine is told and the host has in another form. */
static void fill_point(usub_driver *driver, const usub_call *call, const usub_point_arrays *at,
                       int32_t p, int32_t lm) {
  const size_t F = (size_t)driver->size.F, P = (size_t)driver->size.P, i = (size_t)p;
  if (usub_is_live(driver, USUB_FRIC_TAULM)) {
    double *taulm = call->argv[USUB_FRIC_TAULM];
    for (size_t a = 0; a < F; ++a)
      taulm[a] = lm == USUB_STICKING && at->multiplier ? at->multiplier[i * F + a] : 0;
  }
  if (usub_is_live(driver, USUB_FRIC_DPRESS))
    *(double *)call->argv[USUB_FRIC_DPRESS] = at->pressure[i] - at->committed_pressure[i];
  if (usub_is_live(driver, USUB_FRIC_NODE))
    *(int32_t *)call->argv[USUB_FRIC_NODE] = p + 1;
  if (usub_is_live(driver, USUB_FRIC_TEMP)) {
    double *temp = call->argv[USUB_FRIC_TEMP];
    temp[0] = at->temperature[0][i];
    temp[1] = at->temperature[1][i];
  }
  if (usub_is_live(driver, USUB_FRIC_PREDEF)) {
    double *predef = call->argv[USUB_FRIC_PREDEF];
    for (size_t j = 0; j < P; ++j) {
      predef[2 * j] = at->field[0][i * P + j];
      predef[2 * j + 1] = at->field[1][i * P + j];
    }
  }
}

/* A point that the host constrains (1) or leaves alone (2): nothing else of the answer counts. */
static int32_t take_constraint(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                               int32_t index, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  const int sticks = at->lm[i] == USUB_STICKING;
  const double *from = at->multiplier ? at->multiplier + i * F : at->committed_tau + i * F;
  double *tau = at->tau + i * F;
  for (size_t a = 0; a < F; ++a)
    tau[a] = sticks ? from[a] : 0;
  if (sticks && usub_first_bad_of_few(tau, driver->size.F) >= 0)
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "FRIC: multiplier of point %d is not finite, but the routine returned "
                           "LM = 1",
                           p);
  usub_clear_slip_and_tangent(at, driver->size.F, p);
  at->sed[i] = sticks ? at->committed_sed[i] : 0;
  at->sfd[i] = 0;
  return USUB_OK;
}

/* Applies the meaning of the answer; refuses what no host could use. */
static int32_t take_answer(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p) {
  if (usub_used(driver, USUB_FRIC_LM) == 0)
    at->lm[p] = 0; /* a routine that only knows TAU */
  const int32_t lm = at->lm[p];
  if (lm < 0 || lm > 2)
    return usub_block_fail(driver, call, index, p, USUB_CONTRACT,
                           "FRIC: the routine returned LM = %d at point %d; expected 0, 1 or 2", lm,
                           p);
  if (usub_is_live(driver, USUB_FRIC_PNEWDT)) {
    const double pnewdt = *(double *)call->argv[USUB_FRIC_PNEWDT];
    if (!(pnewdt > 0))
      return usub_block_fail(driver, call, index, p, USUB_CONTRACT,
                             "FRIC: the routine returned PNEWDT = %g at point %d; expected a value "
                             "above 0",
                             pnewdt, p);
    if (pnewdt < call->pnewdt)
      call->pnewdt = pnewdt;
  }
  const int32_t status =
      lm == 0 ? usub_check_answers(driver, call, at, index, p, "the routine returned")
              : take_constraint(driver, call, at, index, p);
  return status ? status : usub_check_trial_state(driver, call, index, p);
}

int32_t usub_fric_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                        int32_t index, int32_t p) {
  const int32_t lm = lm_on_entry(driver, at, p);
  usub_aim(driver, call, p, 1);
  fill_answers(driver, call, at, p, lm);
  fill_point(driver, call, at, p, lm);
  int32_t status = usub_check_inputs(driver, call, index, p);
  if (status)
    return status;
  status = usub_call_routine(driver, call);
  if (status < 0)
    return usub_block_fail(driver, call, index, p, status,
                           "FRIC: the routine ended with %s at point %d",
                           status == USUB_ROUTINE_RAISED ? "an exception" : "its status", p);
  return take_answer(driver, call, at, index, p);
}
