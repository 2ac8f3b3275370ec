/* SPDX-License-Identifier: MIT */
/* Many points of FRIC together: what is done for each of them is done in loops over the arrays.
 *
 * Nothing is refused here. Where there is something to refuse, the same points are done again one
 * by one, which finds the first of them and its message. */
#include <math.h>
#include <string.h>

#include "standard.h"

/* Whether the host's own numbers can be used. */
static int is_usual(const usub_point_arrays *at, int32_t first, int32_t n, size_t F) {
  const size_t i = (size_t)first;
  return usub_first_bad(at->pressure + i, (size_t)n, 0) < 0 &&
         usub_first_bad(at->slip_increment + i * F, (size_t)n * F, 0) < 0;
}

/* Clears what points return; committed values where the rules ask for them. */
static void reset(usub_driver *driver, const usub_point_arrays *at, size_t i, size_t n, size_t F) {
  const size_t S = (size_t)driver->size.S;
  if (at->ddtddg)
    memset(at->ddtddg + i * F * F, 0, n * F * F * sizeof(double));
  if (at->ddtddp)
    memset(at->ddtddp + i * F, 0, n * F * sizeof(double));
  if (at->ddtddt)
    memset(at->ddtddt + i * F * 2, 0, n * F * 2 * sizeof(double));
  memset(at->sfd + i, 0, n * sizeof(double));
  if (S)
    memcpy(driver->last.trial_state + i * S, at->state + i * S, n * S * sizeof(double));
}

/* Which points are closed. Returns how many. */
static int32_t find_closed(const usub_point_arrays *at, int32_t first, size_t n,
                           unsigned char *restrict closed) {
  int32_t count = 0;
  if (at->closed) {
    const int32_t *restrict given = at->closed + first;
    for (size_t k = 0; k < n; ++k)
      count += closed[k] = given[k] != 0;
  } else {
    const double *restrict pressure = at->pressure + first;
    for (size_t k = 0; k < n; ++k)
      count += closed[k] = pressure[k] > 0;
  }
  return count;
}

/* LM on entry. Both values are loaded, since which one it will be cannot be foreseen. */
static void enter(size_t n, int32_t *restrict lm, const unsigned char *restrict closed,
                  const unsigned char *restrict closed_before, const int32_t *restrict lm_before,
                  const int32_t *restrict condition, int32_t again) {
  for (size_t k = 0; k < n; ++k) {
    const int32_t use = again & closed_before[k];
    const int32_t entry = use ? lm_before[k] : condition[k];
    lm[k] = closed[k] ? entry : USUB_OPEN;
  }
}

/* `F` numbers a point. */
static void choose_vectors(size_t n, size_t F, double *restrict to, const double *restrict from,
                           const unsigned char *restrict wanted) {
  if (F == 2)
    usub_choose(n, 2, to, from, wanted);
  else
    usub_choose(n, 1, to, from, wanted);
}

/* What the routine continues from, and zero for open points. */
static void start(const usub_point_arrays *at, const usub_iteration *last, size_t i, size_t n,
                  size_t F) {
  unsigned char *closed = last->trial_closed + i;
  enter(n, at->lm + i, closed, last->closed + i, last->lm + i, at->condition + i, last->done);
  usub_choose(n, 1, at->sed + i, at->committed_sed + i, closed);
  choose_vectors(n, F, at->tau + i * F, at->committed_tau + i * F, closed);
  if (!last->done) {
    memset(at->dslip + i * F, 0, n * F * sizeof(double));
    return;
  }
  unsigned char slipped[USUB_LONGEST_RUN];
  const int32_t *lm = at->lm + i;
  for (size_t k = 0; k < n; ++k)
    slipped[k] = last->closed[i + k] & (lm[k] == USUB_SLIPPING);
  choose_vectors(n, F, at->dslip + i * F, last->dslip + i * F, slipped);
}

/* Whether all closed points returned LM = 0 and PNEWDT is not looked at: nothing to apply. */
static int is_plain(const usub_driver *driver, const usub_call *call, const usub_point_arrays *at,
                    int32_t first) {
  if (usub_is_live(driver, USUB_FRIC_PNEWDT) || usub_used(driver, USUB_FRIC_LM) == 0)
    return 0;
  const unsigned char *closed = driver->last.trial_closed + first;
  const int32_t *lm = at->lm + first;
  int32_t any = 0;
  for (int32_t k = 0; k < call->n; ++k)
    any |= closed[k] ? lm[k] : 0;
  return any == 0;
}

/* Applies the meaning of LM and PNEWDT; 0 if one of them, or a constraint, is to be refused. */
static int take_conditions(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t first) {
  const unsigned char *closed = driver->last.trial_closed + first;
  const double *pnewdt =
      usub_is_live(driver, USUB_FRIC_PNEWDT) ? call->argv[USUB_FRIC_PNEWDT] : NULL;
  const int unknown = usub_used(driver, USUB_FRIC_LM) == 0; /* a routine that only knows TAU */
  double least = call->pnewdt;
  for (int32_t k = 0; k < call->n; ++k) {
    int32_t *lm = &at->lm[first + k];
    if (!closed[k])
      continue;
    if (unknown)
      *lm = 0;
    if (pnewdt) {
      if (!(pnewdt[k] > 0))
        return 0;
      least = pnewdt[k] < least ? pnewdt[k] : least;
    }
    if (*lm == 0)
      continue;
    if (*lm < 0 || *lm > 2)
      return 0;
    const double *multiplier = at->multiplier;
    const size_t F = (size_t)driver->size.F, i = (size_t)(first + k);
    if (*lm == USUB_STICKING && multiplier &&
        usub_first_bad_of_few(multiplier + i * F, driver->size.F) >= 0)
      return 0;
    if (usub_fric_constrain(driver, call, at, index, first + k) != USUB_OK)
      return 0;
  }
  call->pnewdt = least;
  return 1;
}

/* Whether there is no NaN or infinity in what the points return and keep. */
static int is_finite(const usub_driver *driver, const usub_point_arrays *at, size_t i, size_t n) {
  const size_t F = (size_t)driver->size.F, S = (size_t)driver->size.S;
  return usub_first_bad(at->tau + i * F, n * F, 0) < 0 &&
         usub_first_bad(at->dslip + i * F, n * F, 0) < 0 &&
         (!at->ddtddg || usub_first_bad(at->ddtddg + i * F * F, n * F * F, 0) < 0) &&
         (!at->ddtddp || usub_first_bad(at->ddtddp + i * F, n * F, 0) < 0) &&
         (!at->ddtddt || usub_first_bad(at->ddtddt + i * F * 2, n * F * 2, 0) < 0) &&
         usub_first_bad(at->sed + i, n, 0) < 0 && usub_first_bad(at->sfd + i, n, 0) < 0 &&
         (!S || usub_first_bad(driver->last.trial_state + i * S, n * S, 0) < 0);
}

int32_t usub_fric_together(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t first, int32_t n) {
  const size_t F = (size_t)driver->size.F, i = (size_t)first;
  if (!is_usual(at, first, n, F))
    return USUB_ONE_BY_ONE;
  reset(driver, at, i, (size_t)n, F);
  const int32_t closed = find_closed(at, first, (size_t)n, driver->last.trial_closed + i);
  start(at, &driver->last, i, (size_t)n, F);
  if (!closed)
    return USUB_OK;
  usub_aim(driver, call, first, n);
  usub_fric_fill(driver, call, at, first);
  if (!usub_inputs_are_finite(driver, call))
    return USUB_ONE_BY_ONE;
  const int32_t ended = usub_call_closed(driver, call, driver->last.trial_closed + first);
  if (ended < 0)
    return usub_fric_ended(driver, call, at, index, first, ended, usub_failure(ended));
  call->done = call->before = 0;
  const int usual =
      is_plain(driver, call, at, first) || take_conditions(driver, call, at, index, first);
  if (usual && is_finite(driver, at, i, (size_t)n))
    return USUB_OK;
  return usub_fric_take(driver, call, at, index, first, n);
}
