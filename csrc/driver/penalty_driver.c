/* SPDX-License-Identifier: MIT */
/* FRIC_COEF in a standard driver: the routine gives coefficients, penalty.c enforces them.
 *
 * The routine is called with nBlock = 1, in the layout of its generation; a routine of unknown
 * generation gets the 2022 layout, of which the legacy one is a part at nBlock = 1. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "penalty.h"
#include "standard.h"

enum { COEF = USUB_FRIC_COEF_2022_FCOEF, DERIV = USUB_FRIC_COEF_2022_FCOEFDERIV };
enum { FLAGS = USUB_FRIC_COEF_2022_IDATA, RDATA = USUB_FRIC_COEF_2022_RDATA };
enum { SLIP = USUB_FRIC_COEF_2022_SLIPDATA, TEMP = USUB_FRIC_COEF_2022_TEMPAVG };
enum { PRESSURE = USUB_FRIC_COEF_2022_PRESSURE, FIELD = USUB_FRIC_COEF_2022_FIELDAVG };
enum { DERIVATIVES = 20, NAMED_DERIVATIVES = 8, LEGACY_DERIVATIVES = 3, RDATA_HEAD = 7 };

static int is_2022(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_FRIC_COEF_2022;
}

void usub_penalty_plan(usub_driver *driver) {
  const size_t real = sizeof(double), fields = (size_t)driver->size.P * real;
  const int modern = is_2022(driver);
  usub_put_coefficient_common(driver);
  usub_put_scratch(driver, COEF, 0, 2 * real, "output", "enforced by the penalty method");
  usub_put_scratch(driver, DERIV, 0, 2 * DERIVATIVES * real, "output",
                   driver->set.tangent ? "derivatives for the tangent" : "not wanted by the scene");
  usub_put_scratch(driver, SLIP, 0, 6 * real, "computed",
                   modern ? "slip rate and slip" : "equivalent slip rate");
  usub_put_array(driver, PRESSURE, "pressure", NULL);
  if (modern) {
    usub_put_scratch(driver, FLAGS, 0, 6 * sizeof(int32_t), "computed", "step, increment, node");
    usub_put_scratch(driver, RDATA, 0, (RDATA_HEAD + (size_t)driver->size.S) * real, "computed",
                     "times, rotation, state variables");
  }
  if (driver->set.temperatures) {
    usub_need_array(driver, TEMP, "temperature_secondary");
    usub_need_array(driver, TEMP, "temperature_main");
  }
  if (driver->set.temperatures && usub_data(driver, "temperature_secondary") &&
      usub_data(driver, "temperature_main"))
    usub_put_scratch(driver, TEMP, 0, real, "computed", "mean of the two surfaces");
  else
    usub_put_absent(driver, TEMP, real, "the scene has no temperatures");
  usub_need_array(driver, FIELD, "field_secondary");
  usub_need_array(driver, FIELD, "field_main");
  if (fields && usub_data(driver, "field_secondary") && usub_data(driver, "field_main"))
    usub_put_scratch(driver, FIELD, 0, fields, "computed", "mean of the two surfaces");
  else
    usub_put_absent(driver, FIELD, fields, "the scene has no fields");
}

typedef struct question {
  usub_driver *driver;
  usub_call *call;
  const usub_point_arrays *at;
  int32_t index, point;
} question;

/* Arguments that depend on the point alone. */
static void fill_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                       int32_t p) {
  const size_t P = (size_t)driver->size.P, i = (size_t)p;
  usub_aim(driver, call, p, 1);
  if (usub_is_live(driver, TEMP))
    *(double *)call->argv[TEMP] = 0.5 * at->temperature[0][i] + 0.5 * at->temperature[1][i];
  if (usub_is_live(driver, FIELD))
    for (size_t j = 0; j < P; ++j)
      ((double *)call->argv[FIELD])[j] = 0.5 * at->field[0][i * P + j] + 0.5 * at->field[1][i * P + j];
  if (is_2022(driver) && usub_is_live(driver, FLAGS)) {
    const int32_t flags[6] = {driver->clock.flags[0], driver->clock.flags[1],
                              driver->clock.iteration, at->node ? at->node[i] : p + 1,
                              driver->size.S, driver->size.F};
    memcpy(call->argv[FLAGS], flags, sizeof flags);
  }
}

/* State variables start from the committed values in every call. */
static void fill_rdata(const question *q) {
  const usub_driver *driver = q->driver;
  const size_t S = (size_t)driver->size.S, i = (size_t)q->point;
  double *rdata = q->call->argv[RDATA];
  memcpy(rdata, driver->clock.time, 3 * sizeof(double));
  const double identity[4] = {1, 0, 0, 1};
  memcpy(rdata + 3, q->at->rotation ? q->at->rotation + 4 * i : identity, sizeof identity);
  if (S) memcpy(rdata + RDATA_HEAD, q->at->state + i * S, S * sizeof(double));
}

static int32_t refuse(const question *q, int32_t status, const char *what) {
  return usub_block_fail(q->driver, q->call, q->index, q->point, status, "FRIC_COEF: %s at point %d", what,
                         q->point);
}

/* Asks the routine for the coefficients at one slip. */
static int32_t ask(void *context, const double slip_data[6], usub_friction_value *value) {
  const question *q = context;
  usub_driver *driver = q->driver;
  usub_call *call = q->call;
  const int modern = is_2022(driver);
  double *coef = call->argv[COEF], *deriv = call->argv[DERIV];
  if (usub_is_live(driver, SLIP)) memcpy(call->argv[SLIP], slip_data, 6 * sizeof(double));
  if (modern && usub_is_live(driver, RDATA)) fill_rdata(q);
  coef[0] = 0;
  coef[1] = NAN; /* tells whether an isotropic routine left it alone */
  const int reads_derivatives = usub_is_live(driver, DERIV);
  if (reads_derivatives) memset(deriv, 0, 2 * DERIVATIVES * sizeof(double));
  const int32_t status = usub_call_routine(driver, call);
  if (status < 0)
    return refuse(q, status, status == USUB_ROUTINE_RAISED ? "the routine ended with an exception"
                                                           : "the routine ended with its status");
  const int touched = !isnan(coef[1]);
  if (touched && !driver->set.anisotropic)
    return refuse(q, USUB_CONTRACT,
                  "the routine set fCoef(1,2), but the scene is isotropic: set its 'anisotropic' to 1 "
                  "or leave the second coefficient alone; seen");
  if (driver->set.anisotropic && !touched)
    return refuse(q, USUB_CONTRACT,
                  "the routine left fCoef(1,2) alone or NaN, but the scene is anisotropic; seen");
  memset(value, 0, sizeof *value);
  value->mu[0] = coef[0];
  value->mu[1] = touched ? coef[1] : coef[0];
  const int named = modern ? NAMED_DERIVATIVES : LEGACY_DERIVATIVES;
  for (int m = 0; reads_derivatives && m < 2; ++m)
    for (int j = 0; j < named; ++j)
      value->d_mu[m][j] = deriv[touched && m ? DERIVATIVES + j : j];
  return USUB_OK;
}

static void keep_point(usub_driver *driver, const usub_call *call, const usub_point_arrays *at,
                       int32_t p, const usub_penalty_output *out) {
  const size_t F = (size_t)driver->size.F, S = (size_t)driver->size.S, i = (size_t)p;
  for (size_t a = 0; a < F; ++a) {
    at->tau[i * F + a] = out->tau[a];
    at->dslip[i * F + a] = out->slip_increment_plastic[a];
    driver->trial_elastic[i * F + a] = out->elastic_slip[a];
    if (at->ddtddp) at->ddtddp[i * F + a] = out->d_tau_d_pressure[a];
    for (size_t b = 0; b < F && at->ddtddg; ++b)
      at->ddtddg[(i * F + b) * F + a] = out->d_tau_d_gamma[a][b]; /* column-major */
    for (size_t s = 0; s < 2 && at->ddtddt; ++s) /* the mean has half of each temperature */
      at->ddtddt[(i * 2 + s) * F + a] = 0.5 * out->d_tau_d_temperature[a];
  }
  driver->trial_equivalent[i] = at->equivalent_slip[i] + out->equivalent_slip_increment;
  at->sed[i] = out->sed;
  at->sfd[i] = out->sfd;
  at->coefficient[2 * i] = out->mu[0];
  at->coefficient[2 * i + 1] = out->mu[1];
  if (S && is_2022(driver) && usub_is_live(driver, RDATA))
    memcpy(driver->trial_state + i * S, (const double *)call->argv[RDATA] + RDATA_HEAD,
           S * sizeof(double));
}

int32_t usub_penalty_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p) {
  const usub_settings *set = &driver->set;
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  /* The local directions have turned by `rotation` since the elastic slip was committed. */
  double elastic[2] = {at->elastic_slip[i * F], F == 2 ? at->elastic_slip[i * F + 1] : 0};
  if (at->rotation && F == 2) {
    const double *turn = at->rotation + 4 * i, old[2] = {elastic[0], elastic[1]};
    for (size_t a = 0; a < 2; ++a) elastic[a] = turn[a] * old[0] + turn[2 + a] * old[1];
  }
  const usub_penalty_input input = {
      .directions = driver->size.F,
      .anisotropic = set->anisotropic,
      .pressure = at->pressure[i],
      .time_increment = driver->clock.time[2],
      .critical_elastic_slip = set->elastic_slip > 0
                                   ? set->elastic_slip
                                   : set->slip_tolerance * set->characteristic_length,
      .shear_limit = set->shear_limit,
      .elastic_slip = elastic,
      .slip = at->slip + i * F,
      .slip_increment = at->slip_increment + i * F,
      .equivalent_slip = at->equivalent_slip[i],
  };
  question q = {driver, call, at, index, p};
  usub_penalty_output out;
  fill_point(driver, call, at, p);
  at->lm[p] = 0;
  int32_t status = usub_check_inputs(driver, call, index, p);
  if (status) return status;
  const int want = set->tangent || set->temperature_tangent;
  status = usub_penalty_update(&input, ask, &q, want, &out);
  if (status < 0) {
    if (call->status && call->failed_point == p) return status; /* `ask` has said why */
    char what[96];
    snprintf(what, sizeof what, "%s (fCoef %g, pressure %g)", usub_status_text(status), out.mu[0],
             at->pressure[i]);
    return refuse(&q, status, what);
  }
  keep_point(driver, call, at, p, &out);
  return USUB_OK;
}

void usub_penalty_open_point(usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  memset(driver->trial_elastic + i * F, 0, F * sizeof(double));
  driver->trial_equivalent[i] = at->equivalent_slip[i];
  at->coefficient[2 * i] = at->coefficient[2 * i + 1] = 0;
}
