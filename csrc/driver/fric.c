/* SPDX-License-Identifier: MIT */
/* Points of FRIC: what goes in, and what the answers mean. */
#include <string.h>

#include "standard.h"

/* Empties memory of the worker that the routine may write to. */
static void empty(usub_driver *driver, const usub_call *call, int32_t position) {
  if (usub_is_live(driver, position))
    memset(call->argv[position], 0, (size_t)call->n * driver->sources[position].per_point);
}

/* What the routine continues from. */
static void fill_answer(usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const usub_iteration *last = &driver->last;
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  at->lm[i] = usub_lm_on_entry(driver, at, p);
  memcpy(at->tau + i * F, at->committed_tau + i * F, F * sizeof(double));
  at->sed[i] = at->committed_sed[i];
  if (last->done && last->closed[p] && at->lm[i] == USUB_SLIPPING)
    memcpy(at->dslip + i * F, last->dslip + i * F, F * sizeof(double));
}

void usub_fric_fill(usub_driver *driver, const usub_call *call, const usub_point_arrays *at,
                    int32_t first) {
  /* Tangents that the host wants were cleared with the point. */
  empty(driver, call, USUB_FRIC_DDTDDG);
  empty(driver, call, USUB_FRIC_DDTDDP);
  empty(driver, call, USUB_FRIC_DDTDDT);
  if (usub_is_live(driver, USUB_FRIC_PNEWDT))
    for (int32_t k = 0; k < call->n; ++k)
      ((double *)call->argv[USUB_FRIC_PNEWDT])[k] = USUB_PNEWDT_PRESET;
  const size_t F = (size_t)driver->size.F, P = (size_t)driver->size.P;
  const size_t n = (size_t)call->n, i = (size_t)first;
  if (usub_is_live(driver, USUB_FRIC_TAULM)) {
    double *taulm = call->argv[USUB_FRIC_TAULM];
    for (size_t a = 0; a < n * F; ++a)
      taulm[a] =
          at->lm[i + a / F] == USUB_STICKING && at->multiplier ? at->multiplier[i * F + a] : 0;
  }
  if (usub_is_live(driver, USUB_FRIC_DPRESS)) {
    double *dpress = call->argv[USUB_FRIC_DPRESS];
    for (size_t k = 0; k < n; ++k)
      dpress[k] = at->pressure[i + k] - at->committed_pressure[i + k];
  }
  if (usub_is_live(driver, USUB_FRIC_NODE)) {
    int32_t *node = call->argv[USUB_FRIC_NODE];
    for (int32_t k = 0; k < call->n; ++k)
      node[k] = first + k + 1;
  }
  if (usub_is_live(driver, USUB_FRIC_TEMP)) {
    double *temp = call->argv[USUB_FRIC_TEMP];
    for (size_t k = 0; k < 2 * n; ++k)
      temp[k] = at->temperature[k % 2][i + k / 2];
  }
  if (usub_is_live(driver, USUB_FRIC_PREDEF)) {
    double *predef = call->argv[USUB_FRIC_PREDEF];
    for (size_t j = 0; j < 2 * n * P; ++j)
      predef[j] = at->field[j % 2][i * P + j / 2];
  }
}

int32_t usub_fric_constrain(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
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

/* Applies the meaning of the answer of point `p`, the k-th of the call; refuses what no host could
 * use. */
static int32_t take_answer(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p, int32_t k) {
  if (usub_used(driver, USUB_FRIC_LM) == 0)
    at->lm[p] = 0; /* a routine that only knows TAU */
  const int32_t lm = at->lm[p];
  if (lm < 0 || lm > 2)
    return usub_block_fail(driver, call, index, p, USUB_CONTRACT,
                           "FRIC: the routine returned LM = %d at point %d; expected 0, 1 or 2", lm,
                           p);
  if (usub_is_live(driver, USUB_FRIC_PNEWDT)) {
    const double pnewdt = ((double *)call->argv[USUB_FRIC_PNEWDT])[k];
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
              : usub_fric_constrain(driver, call, at, index, p);
  return status ? status : usub_check_trial_state(driver, call, index, p);
}

int32_t usub_fric_take(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                       int32_t index, int32_t first, int32_t count) {
  int32_t status = USUB_OK;
  for (int32_t k = 0; k < count && !status; ++k)
    if (driver->last.trial_closed[first + k])
      status = take_answer(driver, call, at, index, first + k, k);
  return status;
}

int32_t usub_fric_ended(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                        int32_t index, int32_t first, int32_t ended, const char *reason) {
  const int32_t done = call->done;
  call->done = 0; /* what happens from here on does not happen in the routine */
  int32_t status = usub_fric_take(driver, call, at, index, first, done);
  if (!status)
    status = usub_checked_fail(driver, call, index, first + done, ended);
  return status ? status
                : usub_block_fail(driver, call, index, first + done, ended,
                                  "%s: the routine ended with %s at point %d", driver->title,
                                  reason, first + done);
}

int32_t usub_fric_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                        int32_t index, int32_t p) {
  usub_aim(driver, call, p, 1);
  fill_answer(driver, at, p);
  usub_fric_fill(driver, call, at, p);
  const int32_t status = usub_check_inputs(driver, call, index, p);
  if (status)
    return status;
  const int32_t ended = usub_call_routine(driver, call);
  if (ended < 0)
    return usub_fric_ended(driver, call, at, index, p, ended, usub_failure(ended));
  call->done = 0;
  return usub_fric_take(driver, call, at, index, p, 1);
}
