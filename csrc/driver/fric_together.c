/* SPDX-License-Identifier: MIT */
/* Many points of FRIC together: what is done for each of them is done in loops over the arrays.
 *
 * Nothing is refused here. Where there is something to refuse, the same points are done again one
 * by one, which finds the first of them and its message. */
#include <math.h>
#include <string.h>

#include "standard.h"

/* Points of a call by their condition, counted from its first one, in their order. */
typedef struct places {
  int32_t closed[USUB_LONGEST_RUN], open[USUB_LONGEST_RUN];
  int32_t closed_count, open_count;
} places;

/* Whether the host's own numbers can be used. */
static int is_usual(const usub_point_arrays *at, size_t i, size_t n, size_t F) {
  const usub_span given[] = {{at->pressure + i, n}, {at->slip_increment + i * F, n * F}};
  return usub_all_finite(given, sizeof given / sizeof given[0]);
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

/* Which points are closed. Without branches: which it will be cannot be foreseen. */
static void find_closed(const usub_point_arrays *at, size_t i, size_t n,
                        unsigned char *restrict closed, places *restrict found) {
  if (at->closed)
    for (size_t k = 0; k < n; ++k)
      closed[k] = at->closed[i + k] != 0;
  else
    for (size_t k = 0; k < n; ++k)
      closed[k] = at->pressure[i + k] > 0;
  int32_t count = 0;
  for (int32_t k = 0; k < (int32_t)n; ++k) {
    found->closed[count] = found->open[k - count] = k;
    count += closed[k];
  }
  found->closed_count = count;
  found->open_count = (int32_t)n - count;
}

/* LM on entry of closed points. */
static void enter(size_t n, int32_t *restrict lm, const unsigned char *restrict closed_before,
                  const int32_t *restrict lm_before, const int32_t *restrict condition) {
  for (size_t k = 0; k < n; ++k) {
    const int32_t again = -(int32_t)closed_before[k];
    lm[k] = (lm_before[k] & again) | (condition[k] & ~again);
  }
}

/* What the routine continues from, and zero for open points. */
static void start(const usub_point_arrays *at, const usub_iteration *last, size_t i, size_t n,
                  size_t F, const places *found) {
  double *tau = at->tau + i * F, *dslip = at->dslip + i * F, *sed = at->sed + i;
  int32_t *lm = at->lm + i;
  memcpy(tau, at->committed_tau + i * F, n * F * sizeof(double));
  memcpy(sed, at->committed_sed + i, n * sizeof(double));
  if (last->done) {
    enter(n, lm, last->closed + i, last->lm + i, at->condition + i);
    /* Zero where the point was open, stuck or free of friction. */
    memcpy(dslip, last->dslip + i * F, n * F * sizeof(double));
  } else {
    memcpy(lm, at->condition + i, n * sizeof *lm);
    memset(dslip, 0, n * F * sizeof(double));
  }
  for (int32_t j = 0; j < found->open_count; ++j) {
    const size_t k = (size_t)found->open[j], head = k * F, tail = head + F - 1; /* F is 1 or 2 */
    lm[k] = USUB_OPEN;
    sed[k] = tau[head] = tau[tail] = dslip[head] = dslip[tail] = 0;
  }
}

/* Whether all closed points returned LM = 0 and PNEWDT is not looked at: nothing to apply. */
static int is_plain(const usub_driver *driver, const usub_point_arrays *at, int32_t first,
                    const places *found) {
  if (usub_is_live(driver, USUB_FRIC_PNEWDT) || usub_used(driver, USUB_FRIC_LM) == 0)
    return 0;
  const int32_t *lm = at->lm + first;
  int32_t any = 0;
  for (int32_t j = 0; j < found->closed_count; ++j)
    any |= lm[found->closed[j]];
  return any == 0;
}

/* Applies the meaning of LM and PNEWDT; 0 if one of them, or a constraint, is to be refused. */
static int take_conditions(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t first, const places *found) {
  const double *pnewdt =
      usub_is_live(driver, USUB_FRIC_PNEWDT) ? call->argv[USUB_FRIC_PNEWDT] : NULL;
  const int unknown = usub_used(driver, USUB_FRIC_LM) == 0; /* a routine that only knows TAU */
  double least = call->pnewdt;
  for (int32_t j = 0; j < found->closed_count; ++j) {
    const int32_t k = found->closed[j];
    int32_t *lm = &at->lm[first + k];
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
  const usub_span kept[] = {
      {at->tau + i * F, n * F},
      {at->dslip + i * F, n * F},
      {at->sed + i, n},
      {at->sfd + i, n},
      {at->ddtddg ? at->ddtddg + i * F * F : NULL, n * F * F},
      {at->ddtddp ? at->ddtddp + i * F : NULL, n * F},
      {at->ddtddt ? at->ddtddt + i * F * 2 : NULL, n * F * 2},
      {S ? driver->last.trial_state + i * S : NULL, n * S},
  };
  return usub_all_finite(kept, sizeof kept / sizeof kept[0]);
}

int32_t usub_fric_together(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t first, int32_t n) {
  const size_t F = (size_t)driver->size.F, i = (size_t)first;
  if (!is_usual(at, i, (size_t)n, F))
    return USUB_ONE_BY_ONE;
  places found;
  find_closed(at, i, (size_t)n, driver->last.trial_closed + i, &found);
  reset(driver, at, i, (size_t)n, F);
  start(at, &driver->last, i, (size_t)n, F, &found);
  if (!found.closed_count)
    return USUB_OK;
  usub_aim(driver, call, first, n);
  usub_fric_fill(driver, call, at, first);
  if (!usub_inputs_are_finite(driver, call))
    return USUB_ONE_BY_ONE;
  const int32_t ended = usub_call_listed(driver, call, found.closed, found.closed_count);
  if (ended < 0)
    return usub_fric_ended(driver, call, at, index, first, ended, usub_failure(ended));
  call->done = 0;
  const int usual = is_plain(driver, at, first, &found) ||
                    take_conditions(driver, call, at, index, first, &found);
  if (usual && is_finite(driver, at, i, (size_t)n))
    return USUB_OK;
  return usub_fric_take(driver, call, at, index, first, n);
}
