/* SPDX-License-Identifier: MIT */
/* The standard drivers: increments, iterations, committed and trial state.
 *
 * Committed values live in slots of role "state" and change in usub_commit alone. An iteration
 * writes the slots of role "out" and the trial memory; the last_* arrays keep what the next
 * iteration needs of this one (LM, DSLIP, open or closed) and are replaced only if the whole
 * iteration succeeds, so that a failed one never happened. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "internal.h"
#include "standard.h"

static const double identity[4] = {1, 0, 0, 1};

enum { SLIPPING = 0, STICKING = 1, OPEN = 2 };

static int is_fric(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_FRIC;
}

int32_t usub_standard_create(usub_driver *driver) {
  const size_t N = (size_t)driver->size.N, F = (size_t)driver->size.F, S = (size_t)driver->size.S;
  driver->last_lm = calloc(N, sizeof *driver->last_lm);
  driver->last_closed = calloc(N, 1);
  driver->closed_now = calloc(N, 1);
  driver->last_dslip = calloc(N * F, sizeof(double));
  driver->trial_state = calloc(N * (S > 0 ? S : 1), sizeof(double));
  if (!driver->last_lm || !driver->last_closed || !driver->closed_now || !driver->last_dslip ||
      !driver->trial_state)
    return USUB_NO_MEMORY;
  if (!is_fric(driver)) {
    driver->trial_elastic = calloc(N * F, sizeof(double));
    driver->trial_equivalent = calloc(N, sizeof(double));
    if (!driver->trial_elastic || !driver->trial_equivalent) return USUB_NO_MEMORY;
  }
  int32_t *condition = usub_data(driver, "condition");
  for (size_t i = 0; i < N; ++i) condition[i] = OPEN; /* nothing was closed before the first increment */
  return USUB_OK;
}

void usub_standard_free(usub_driver *driver) {
  free(driver->last_lm);
  free(driver->last_closed);
  free(driver->closed_now);
  free(driver->last_dslip);
  free(driver->trial_state);
  free(driver->trial_elastic);
  free(driver->trial_equivalent);
}

/* Both surfaces' values of a point, side by side. */
static void put_pair(usub_driver *driver, int32_t position, const char *quantity, int32_t present,
                     size_t bytes, const char *absent) {
  char secondary[40], main[40];
  snprintf(secondary, sizeof secondary, "%s_secondary", quantity);
  snprintf(main, sizeof main, "%s_main", quantity);
  if (present) {
    usub_need_array(driver, position, secondary);
    usub_need_array(driver, position, main);
  }
  if (present && usub_data(driver, secondary) && usub_data(driver, main))
    usub_put_scratch(driver, position, 0, bytes, "gathered", "both surfaces side by side");
  else
    usub_put_absent(driver, position, bytes, present ? "nothing is bound: zeros" : absent);
}

static void put_tangent(usub_driver *driver, int32_t position, const char *array, size_t bytes) {
  if (usub_data(driver, array))
    usub_put_array(driver, position, array, NULL);
  else
    usub_put_scratch(driver, position, 0, bytes, "output", "not wanted by the scene");
}

static void plan_fric(usub_driver *driver) {
  const usub_sizes *size = &driver->size;
  const usub_counts *count = &driver->counts;
  const size_t vector = (size_t)size->F * sizeof(double);
  usub_put_array(driver, USUB_FRIC_LM, "lm", NULL);
  usub_put_array(driver, USUB_FRIC_TAU, "tau", NULL);
  put_tangent(driver, USUB_FRIC_DDTDDG, "ddtddg", (size_t)size->F * vector);
  put_tangent(driver, USUB_FRIC_DDTDDP, "ddtddp", vector);
  usub_put_array(driver, USUB_FRIC_DSLIP, "dslip", NULL);
  usub_put_array(driver, USUB_FRIC_SED, "sed", NULL);
  usub_put_array(driver, USUB_FRIC_SFD, "sfd", NULL);
  put_tangent(driver, USUB_FRIC_DDTDDT, "ddtddt", 2 * vector);
  usub_put_scratch(driver, USUB_FRIC_PNEWDT, 0, sizeof(double), "output", "smallest of all points");
  if (size->S)
    usub_put_memory(driver, USUB_FRIC_STATEV, driver->trial_state, (size_t)size->S * sizeof(double));
  else
    usub_put_absent(driver, USUB_FRIC_STATEV, 0, "the scene has no state variables");
  usub_put_array(driver, USUB_FRIC_DGAM, "slip_increment", NULL);
  usub_put_scratch(driver, USUB_FRIC_TAULM, 0, vector, "computed", "multiplier where LM is 1");
  usub_put_array(driver, USUB_FRIC_PRESS, "pressure", NULL);
  if (usub_data(driver, "pressure_increment"))
    usub_put_array(driver, USUB_FRIC_DPRESS, "pressure_increment", NULL);
  else
    usub_put_scratch(driver, USUB_FRIC_DPRESS, 0, sizeof(double), "computed",
                     "against the committed pressure");
  usub_put_array(driver, USUB_FRIC_DDPDDH, "contact_stiffness", NULL);
  usub_put_array(driver, USUB_FRIC_SLIP, "slip", NULL);
  usub_put_fixed(driver, USUB_FRIC_KSTEP, &driver->clock.flags[0]);
  usub_put_fixed(driver, USUB_FRIC_KINC, &driver->clock.flags[1]);
  usub_put_fixed(driver, USUB_FRIC_TIME, &driver->clock.time[0]);
  usub_put_fixed(driver, USUB_FRIC_DTIME, &driver->clock.time[2]);
  usub_put_array(driver, USUB_FRIC_NOEL, "element", &count->zero);
  usub_put_fixed(driver, USUB_FRIC_CINAME, driver->names[0]);
  usub_put_fixed(driver, USUB_FRIC_SECNAME, driver->names[1]);
  usub_put_fixed(driver, USUB_FRIC_MAINNAME, driver->names[2]);
  usub_put_array(driver, USUB_FRIC_NPT, "integration_point", &count->zero);
  if (usub_data(driver, "node"))
    usub_put_array(driver, USUB_FRIC_NODE, "node", NULL);
  else
    usub_put_scratch(driver, USUB_FRIC_NODE, 0, sizeof(int32_t), "computed", "number of the point");
  usub_put_fixed(driver, USUB_FRIC_NPATCH, &count->zero);
  usub_put_array(driver, USUB_FRIC_COORDS, "coord", NULL);
  usub_put_array(driver, USUB_FRIC_RCOORD, "coord_main", NULL);
  usub_put_array(driver, USUB_FRIC_DROT, "rotation", identity);
  put_pair(driver, USUB_FRIC_TEMP, "temperature", driver->set.temperatures, 2 * sizeof(double),
           "the scene has no temperatures");
  put_pair(driver, USUB_FRIC_PREDEF, "field", size->P, 2 * (size_t)size->P * sizeof(double),
           "the scene has no fields");
  usub_put_fixed(driver, USUB_FRIC_NFDIR, &count->F);
  usub_put_fixed(driver, USUB_FRIC_MCRD, &count->D);
  usub_put_fixed(driver, USUB_FRIC_NPRED, &count->P);
  usub_put_fixed(driver, USUB_FRIC_NSTATV, &count->S);
  usub_put_fixed(driver, USUB_FRIC_CHRLNGTH, &driver->set.characteristic_length);
  usub_put_fixed(driver, USUB_FRIC_PROPS, driver->props);
  usub_put_fixed(driver, USUB_FRIC_NPROPS, &count->props);
}

void usub_standard_plan(usub_driver *driver) {
  if (is_fric(driver))
    plan_fric(driver);
  else
    usub_penalty_plan(driver);
}

/* Clears what a point returns; committed values where the rules ask for them. */
static void reset_point(usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const size_t F = (size_t)driver->size.F, S = (size_t)driver->size.S, i = (size_t)p;
  memset(at->tau + i * F, 0, F * sizeof(double));
  memset(at->dslip + i * F, 0, F * sizeof(double));
  if (at->ddtddg) memset(at->ddtddg + i * F * F, 0, F * F * sizeof(double));
  if (at->ddtddp) memset(at->ddtddp + i * F, 0, F * sizeof(double));
  if (at->ddtddt) memset(at->ddtddt + i * F * 2, 0, F * 2 * sizeof(double));
  at->sed[i] = at->sfd[i] = 0;
  if (S) memcpy(driver->trial_state + i * S, at->state + i * S, S * sizeof(double));
}

/* LM on entry: the routine's own of the last iteration, or the condition of the last increment. */
static int32_t lm_on_entry(const usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  return driver->iterated && driver->last_closed[p] ? driver->last_lm[p] : at->condition[p];
}

static void fill_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                       int32_t p) {
  const size_t F = (size_t)driver->size.F, P = (size_t)driver->size.P, i = (size_t)p;
  const int32_t lm = lm_on_entry(driver, at, p);
  usub_aim(driver, call, p, 1);
  at->lm[i] = lm;
  memcpy(at->tau + i * F, at->committed_tau + i * F, F * sizeof(double));
  at->sed[i] = at->committed_sed[i];
  if (driver->iterated && driver->last_closed[p] && lm == 0)
    memcpy(at->dslip + i * F, driver->last_dslip + i * F, F * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_DDTDDG))
    memset(call->argv[USUB_FRIC_DDTDDG], 0, F * F * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_DDTDDP))
    memset(call->argv[USUB_FRIC_DDTDDP], 0, F * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_DDTDDT))
    memset(call->argv[USUB_FRIC_DDTDDT], 0, F * 2 * sizeof(double));
  if (usub_is_live(driver, USUB_FRIC_PNEWDT))
    *(double *)call->argv[USUB_FRIC_PNEWDT] = USUB_PNEWDT_PRESET;
  if (usub_is_live(driver, USUB_FRIC_TAULM)) {
    double *taulm = call->argv[USUB_FRIC_TAULM];
    for (size_t a = 0; a < F; ++a) taulm[a] = lm == 1 && at->multiplier ? at->multiplier[i * F + a] : 0;
  }
  if (usub_is_live(driver, USUB_FRIC_DPRESS))
    *(double *)call->argv[USUB_FRIC_DPRESS] = at->pressure[i] - at->committed_pressure[i];
  if (usub_is_live(driver, USUB_FRIC_NODE)) *(int32_t *)call->argv[USUB_FRIC_NODE] = p + 1;
  if (usub_is_live(driver, USUB_FRIC_TEMP)) {
    double *temp = call->argv[USUB_FRIC_TEMP];
    temp[0] = at->temperature[0][i];
    temp[1] = at->temperature[1][i];
  }
  if (usub_is_live(driver, USUB_FRIC_PREDEF)) {
    double *predef = call->argv[USUB_FRIC_PREDEF];
    for (size_t j = 0; j < P; ++j)
      for (int side = 0; side < 2; ++side) predef[2 * j + (size_t)side] = at->field[side][i * P + j];
  }
}

/* Applies the meaning of the LM that came back; refuses what no host could use. */
static int32_t empty_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  if (usub_used(driver, USUB_FRIC_LM) == 0) at->lm[i] = 0; /* a routine that only knows TAU */
  const int32_t lm = at->lm[i];
  if (lm < 0 || lm > 2)
    return usub_block_fail(driver, call, index, p, USUB_CONTRACT,
                           "FRIC: the routine returned LM = %d at point %d; expected 0, 1 or 2", lm, p);
  if (usub_is_live(driver, USUB_FRIC_PNEWDT)) {
    const double pnewdt = *(double *)call->argv[USUB_FRIC_PNEWDT];
    if (!(pnewdt > 0))
      return usub_block_fail(driver, call, index, p, USUB_CONTRACT,
                             "FRIC: the routine returned PNEWDT = %g at point %d; expected a value "
                             "above 0",
                             pnewdt, p);
    if (pnewdt < call->pnewdt) call->pnewdt = pnewdt;
  }
  if (lm != 0) { /* the host constrains the point (1) or leaves it alone (2) */
    double *tau = at->tau + i * F;
    for (size_t a = 0; a < F; ++a)
      tau[a] = lm == 2 ? 0 : at->multiplier ? at->multiplier[i * F + a] : at->committed_tau[i * F + a];
    memset(at->dslip + i * F, 0, F * sizeof(double));
    if (at->ddtddg) memset(at->ddtddg + i * F * F, 0, F * F * sizeof(double));
    if (at->ddtddp) memset(at->ddtddp + i * F, 0, F * sizeof(double));
    if (at->ddtddt) memset(at->ddtddt + i * F * 2, 0, F * 2 * sizeof(double));
    at->sed[i] = lm == 2 ? 0 : at->committed_sed[i];
    at->sfd[i] = 0;
    return USUB_OK;
  }
  const struct {
    const char *name;
    const double *data;
    size_t count;
  } outputs[] = {{"TAU", at->tau + i * F, F},
                 {"DDTDDG", at->ddtddg ? at->ddtddg + i * F * F : NULL, F * F},
                 {"DDTDDP", at->ddtddp ? at->ddtddp + i * F : NULL, F},
                 {"DDTDDT", at->ddtddt ? at->ddtddt + i * F * 2 : NULL, F * 2},
                 {"DSLIP", at->dslip + i * F, F},
                 {"SED", at->sed + i, 1},
                 {"SFD", at->sfd + i, 1}};
  for (size_t o = 0; o < sizeof outputs / sizeof outputs[0]; ++o) {
    if (!outputs[o].data) continue;
    const ptrdiff_t bad = usub_first_bad(outputs[o].data, outputs[o].count, 0);
    if (bad >= 0)
      return usub_block_fail(driver, call, index, p, USUB_NOT_FINITE,
                             "FRIC: the routine returned %s, element %d = %g, at point %d",
                             outputs[o].name, (int)bad + 1, outputs[o].data[bad], p);
  }
  return USUB_OK;
}

usub_point_arrays usub_point_arrays_of(const usub_driver *driver) {
  return (usub_point_arrays){
      .lm = driver->memory.lm,
      .condition = driver->memory.condition,
      .closed = driver->memory.closed,
      .node = driver->memory.node,
      .tau = driver->memory.tau,
      .ddtddg = driver->memory.ddtddg,
      .ddtddp = driver->memory.ddtddp,
      .ddtddt = driver->memory.ddtddt,
      .dslip = driver->memory.dslip,
      .sed = driver->memory.sed,
      .sfd = driver->memory.sfd,
      .slip = driver->memory.slip,
      .state = driver->memory.state,
      .committed_tau = driver->memory.committed_tau,
      .committed_sed = driver->memory.committed_sed,
      .committed_pressure = driver->memory.committed_pressure,
      .slip_increment = driver->memory.slip_increment,
      .pressure = driver->memory.pressure,
      .multiplier = driver->memory.multiplier,
      .rotation = driver->memory.rotation,
      .temperature = {driver->memory.temperature_secondary,
                      driver->memory.temperature_main},
      .field = {driver->memory.field_secondary, driver->memory.field_main},
      .elastic_slip = driver->memory.elastic_slip,
      .equivalent_slip = driver->memory.equivalent_slip,
      .coefficient = driver->memory.coefficient,
  };
}

/* Refuses NaN and infinity, and finds out whether the point is closed. */
static int32_t look_at_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                             int32_t index, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  if (!(at->pressure[i] - at->pressure[i] == 0))
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "%s: pressure[%d] = %g; expected a finite value", driver->title, p,
                           at->pressure[i]);
  const ptrdiff_t bad = usub_first_bad(at->slip_increment + i * F, F, 0);
  if (bad >= 0)
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "%s: slip_increment of point %d, direction %d, = %g; expected a finite "
                           "value",
                           driver->title, p, (int)bad + 1, at->slip_increment[i * F + (size_t)bad]);
  driver->closed_now[p] = at->closed ? at->closed[i] != 0 : at->pressure[i] > 0;
  return USUB_OK;
}

static int32_t run_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                         int32_t index, int32_t p) {
  int32_t status = look_at_point(driver, call, at, index, p);
  if (status) return status;
  reset_point(driver, at, p);
  if (!driver->closed_now[p]) {
    at->lm[p] = OPEN;
    if (!is_fric(driver)) usub_penalty_open_point(driver, at, p);
    return USUB_OK;
  }
  if (!is_fric(driver)) return usub_penalty_point(driver, call, at, index, p);
  fill_point(driver, call, at, p);
  status = usub_check_inputs(driver, call, index, p);
  if (status) return status;
  status = usub_call_routine(driver, call);
  if (status < 0)
    return usub_block_fail(driver, call, index, p, status, "FRIC: the routine ended with %s at point %d",
                           status == USUB_ROUTINE_RAISED ? "an exception" : "its status", p);
  return empty_point(driver, call, at, index, p);
}

/* One guard for all points of the block: arming it costs as much as a cheap routine. */
int32_t usub_standard_block(usub_driver *driver, usub_call *call, int32_t index) {
  const usub_point_arrays at = usub_point_arrays_of(driver);
  const int32_t first = index * driver->block;
  const int32_t last = first + driver->block < driver->points ? first + driver->block : driver->points;
  volatile int32_t p = first;
  volatile int32_t status = USUB_OK;
  usub_guard guard;
  usub_guard_push(&guard);
  if (sigsetjmp(guard.env, 0) == 0) {
    for (; p < last && status >= 0; p = p + 1) status = run_point(driver, call, &at, index, p);
  } else {
    status = usub_block_fail(driver, call, index, p, guard.status,
                             "%s: the routine ended with %s at point %d", driver->title, guard.reason, p);
  }
  usub_guard_pop(&guard);
  return status;
}

static int32_t check_order(usub_driver *driver, const char *call, int open) {
  driver->message[0] = 0;
  driver->failed_point = driver->failed_block = -1;
  if (driver->kind != USUB_KIND_OF_STANDARD)
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: %s is not in a standard driver", call, driver->title);
  if (driver->increment_open != open)
    return usub_fail(driver, USUB_WRONG_ORDER, "%s: %s %s", driver->title, call,
                     open ? "needs usub_begin_increment before it"
                          : "came while an increment is open; commit or cut back first");
  return USUB_OK;
}

int32_t usub_begin_increment(usub_driver *driver) {
  if (!driver) return USUB_BAD_ARGUMENT;
  int32_t status = check_order(driver, "usub_begin_increment", 0);
  if (status) return status;
  if (!driver->timed)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: usub_set_time has to come before usub_begin_increment", driver->title);
  driver->increment_open = 1;
  driver->iterated = driver->complete = 0;
  driver->clock.iteration = 0;
  driver->pnewdt = USUB_PNEWDT_PRESET;
  return USUB_OK;
}

int32_t usub_iterate(usub_driver *driver) {
  if (!driver) return USUB_BAD_ARGUMENT;
  int32_t status = check_order(driver, "usub_iterate", 1);
  if (!status) status = usub_prepare(driver);
  if (status) return status;
  for (int32_t w = 0; w < driver->threads; ++w) driver->calls[w].pnewdt = USUB_PNEWDT_PRESET;
  driver->complete = 0;
  driver->clock.iteration += 1;
  status = usub_run_blocks(driver, usub_standard_block);
  if (status < 0) {
    driver->clock.iteration -= 1;
    return status;
  }
  const size_t n = (size_t)driver->points;
  memcpy(driver->last_lm, driver->memory.lm, n * sizeof *driver->last_lm);
  memcpy(driver->last_closed, driver->closed_now, n);
  memcpy(driver->last_dslip, driver->memory.dslip, n * (size_t)driver->size.F * sizeof(double));
  driver->iterated = driver->complete = 1;
  driver->pnewdt = USUB_PNEWDT_PRESET;
  for (int32_t w = 0; w < driver->threads; ++w)
    if (driver->calls[w].pnewdt < driver->pnewdt) driver->pnewdt = driver->calls[w].pnewdt;
  return driver->pnewdt < 1 ? USUB_CUT_BACK : USUB_OK;
}

/* What the point was in the increment that ends: closed and frictionless counts as slipping. */
static int32_t condition_of(const usub_driver *driver, int32_t p) {
  if (!driver->last_closed[p]) return OPEN;
  return driver->last_lm[p] == 1 ? STICKING : SLIPPING;
}

int32_t usub_commit(usub_driver *driver) {
  if (!driver) return USUB_BAD_ARGUMENT;
  int32_t status = check_order(driver, "usub_commit", 1);
  if (status) return status;
  if (!driver->complete)
    return usub_fail(driver, USUB_WRONG_ORDER,
                     "%s: usub_commit needs a usub_iterate before it, and the last one failed or never "
                     "was",
                     driver->title);
  const usub_point_arrays at = usub_point_arrays_of(driver);
  const size_t n = (size_t)driver->points, F = (size_t)driver->size.F, S = (size_t)driver->size.S;
  for (size_t i = 0; i < n * F; ++i) at.slip[i] += driver->last_dslip[i];
  for (size_t i = 0; i < n; ++i) at.condition[i] = condition_of(driver, (int32_t)i);
  memcpy(at.committed_tau, at.tau, n * F * sizeof(double));
  memcpy(at.committed_sed, at.sed, n * sizeof(double));
  memcpy(at.committed_pressure, at.pressure, n * sizeof(double));
  if (S) memcpy(at.state, driver->trial_state, n * S * sizeof(double));
  if (driver->trial_elastic) {
    memcpy(at.elastic_slip, driver->trial_elastic, n * F * sizeof(double));
    memcpy(at.equivalent_slip, driver->trial_equivalent, n * sizeof(double));
  }
  driver->accepted = driver->clock;
  driver->increment_open = 0;
  return USUB_OK;
}

int32_t usub_cut_back(usub_driver *driver) {
  if (!driver) return USUB_BAD_ARGUMENT;
  int32_t status = check_order(driver, "usub_cut_back", 1);
  if (status) return status;
  driver->increment_open = 0;
  driver->iterated = 0;
  return USUB_OK;
}

double usub_pnewdt(const usub_driver *driver) { return driver ? driver->pnewdt : USUB_PNEWDT_PRESET; }
