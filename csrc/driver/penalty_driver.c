/* SPDX-License-Identifier: MIT */
/* FRIC_COEF in a standard driver: the routine gives coefficients, penalty.c enforces them.
 *
 * The routine is called with nBlock = 1, in the layout of its generation; a routine of unknown
 * generation gets the 2022 layout, of which the legacy one is a part at nBlock = 1. */
#include "penalty.h"

#include <math.h>
#include <string.h>

#include "fric_coef.h"
#include "standard.h"

void usub_penalty_plan(usub_driver *driver) {
  const size_t real = sizeof(double), fields = (size_t)driver->size.P * real;
  static const char mean[] = "mean of the two surfaces";
  usub_put_coefficient_common(driver);
  usub_put_scratch(driver, USUB_COEF, 0, 2 * real, "output", "enforced by the penalty method");
  usub_put_scratch(driver, USUB_DERIV, 0, 2 * USUB_DERIVATIVES * real, "output",
                   driver->set.tangent ? "derivatives for the tangent" : "not wanted by the scene");
  usub_put_scratch(driver, USUB_SLIP, 0, USUB_SLIP_COLUMNS * real, "computed",
                   usub_is_2022(driver) ? "slip rate and slip" : "equivalent slip rate");
  usub_put_array(driver, USUB_PRESSURE, "pressure", NULL);
  if (driver->set.temperatures)
    usub_put_pair(driver, USUB_TEMP, "temperature", 0, real, "computed", mean);
  else
    usub_put_absent(driver, USUB_TEMP, real, "the scene has no temperatures");
  if (fields)
    usub_put_pair(driver, USUB_FIELD, "field", 0, fields, "computed", mean);
  else
    usub_put_absent(driver, USUB_FIELD, 0, "the scene has no fields");
}

/* Arguments that depend on the point alone. */
static void fill_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                       int32_t p) {
  const size_t P = (size_t)driver->size.P, i = (size_t)p;
  usub_aim(driver, call, p, 1);
  if (usub_is_live(driver, USUB_TEMP))
    *(double *)call->argv[USUB_TEMP] = 0.5 * at->temperature[0][i] + 0.5 * at->temperature[1][i];
  if (usub_is_live(driver, USUB_FIELD)) {
    double *field = call->argv[USUB_FIELD];
    for (size_t j = 0; j < P; ++j)
      field[j] = 0.5 * at->field[0][i * P + j] + 0.5 * at->field[1][i * P + j];
  }
  usub_fill_flags(driver, call, at->node ? at->node[i] : p + 1);
}

typedef struct question {
  usub_driver *driver;
  usub_call *call;
  const usub_point_arrays *at;
  int32_t index, point;
  double mu; /* the last answer */
} question;

/* Asks the routine for the coefficients at one slip; every call starts from the committed state. */
static int32_t ask(void *context, const double slip_data[6], usub_friction_value *value) {
  question *q = context;
  usub_driver *driver = q->driver;
  usub_call *call = q->call;
  const size_t i = (size_t)q->point, S = (size_t)driver->size.S;
  const double *rotation = q->at->rotation, *state = q->at->state;
  double *coef = call->argv[USUB_COEF], *deriv = call->argv[USUB_DERIV];
  const int modern = usub_is_2022(driver), differentiates = usub_is_live(driver, USUB_DERIV);
  if (usub_is_live(driver, USUB_SLIP))
    memcpy(call->argv[USUB_SLIP], slip_data, USUB_SLIP_COLUMNS * sizeof(double));
  if (modern)
    usub_fill_rdata(driver, call, rotation ? rotation + 4 * i : NULL, S ? state + i * S : NULL);
  coef[0] = 0;
  coef[1] = NAN; /* tells whether an isotropic routine left it alone */
  if (differentiates)
    memset(deriv, 0, 2 * USUB_DERIVATIVES * sizeof(double));
  int32_t status = usub_call_routine(driver, call);
  if (status < 0)
    return usub_block_fail(driver, call, q->index, q->point, status,
                           "FRIC_COEF: the routine ended with %s at point %d",
                           status == USUB_ROUTINE_RAISED ? "an exception" : "its status", q->point);
  status = usub_check_second(driver, call, q->index, q->point, coef[1]);
  if (status)
    return status;
  const int two = driver->set.anisotropic;
  memset(value, 0, sizeof *value);
  value->mu[0] = q->mu = coef[0];
  value->mu[1] = coef[two];
  const int named = modern ? USUB_NAMED_DERIVATIVES : USUB_LEGACY_DERIVATIVES;
  for (int m = 0; differentiates && m < 2; ++m)
    for (int j = 0; j < named; ++j)
      value->d_mu[m][j] = deriv[two * m * USUB_DERIVATIVES + j];
  return USUB_OK;
}

static int32_t keep_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                          int32_t index, int32_t p, const usub_penalty_output *out) {
  const size_t F = (size_t)driver->size.F, S = (size_t)driver->size.S, i = (size_t)p;
  for (size_t a = 0; a < F; ++a) {
    at->tau[i * F + a] = out->tau[a];
    at->dslip[i * F + a] = out->slip_increment_plastic[a];
    driver->last.trial_elastic[i * F + a] = out->elastic_slip[a];
    if (at->ddtddp)
      at->ddtddp[i * F + a] = out->d_tau_d_pressure[a];
    for (size_t b = 0; b < F && at->ddtddg; ++b)
      at->ddtddg[(i * F + b) * F + a] = out->d_tau_d_gamma[a][b]; /* column-major */
    for (size_t s = 0; s < 2 && at->ddtddt; ++s) /* the mean has half of each temperature */
      at->ddtddt[(i * 2 + s) * F + a] = 0.5 * out->d_tau_d_temperature[a];
  }
  driver->last.trial_equivalent[i] = at->equivalent_slip[i] + out->equivalent_slip_increment;
  at->sed[i] = out->sed;
  at->sfd[i] = out->sfd;
  at->coefficient[2 * i] = out->mu[0];
  at->coefficient[2 * i + 1] = out->mu[1];
  const int32_t status =
      usub_check_answers(driver, call, at, index, p, "the coefficients of the routine lead to");
  if (status || !S || !usub_is_2022(driver) || !usub_is_live(driver, USUB_RDATA))
    return status;
  const double *rdata = call->argv[USUB_RDATA];
  memcpy(driver->last.trial_state + i * S, rdata + USUB_RDATA_HEAD, S * sizeof(double));
  return usub_check_trial_state(driver, call, index, p);
}

/* The elastic slip in the directions of now: they may have turned since it was committed. The turn
 * may be NaN. */
static void turned_elastic_slip(const usub_driver *driver, const usub_point_arrays *at, int32_t p,
                                double elastic[2]) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  const double old[2] = {at->elastic_slip[i * F], F == 2 ? at->elastic_slip[i * F + 1] : 0};
  memcpy(elastic, old, sizeof old);
  if (!at->rotation || F < 2)
    return;
  const double *turn = at->rotation + 4 * i;
  for (size_t a = 0; a < 2; ++a)
    elastic[a] = turn[a] * old[0] + turn[2 + a] * old[1];
}

int32_t usub_penalty_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p) {
  const usub_settings *set = &driver->set;
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  double elastic[2];
  turned_elastic_slip(driver, at, p, elastic);
  if (usub_first_bad_of_few(elastic, 2) >= 0)
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "FRIC_COEF: rotation of point %d makes its elastic slip %g; expected a "
                           "rotation",
                           p, elastic[0] + elastic[1]);
  const usub_penalty_input input = {
      .directions = driver->size.F,
      .anisotropic = set->anisotropic,
      .pressure = at->pressure[i],
      .time_increment = driver->clock.time[2],
      .critical_elastic_slip = usub_critical_elastic_slip(set),
      .shear_limit = set->shear_limit,
      .elastic_slip = elastic,
      .slip = at->slip + i * F,
      .slip_increment = at->slip_increment + i * F,
      .equivalent_slip = at->equivalent_slip[i],
  };
  question q = {driver, call, at, index, p, 0};
  usub_penalty_output out;
  fill_point(driver, call, at, p);
  at->lm[p] = 0;
  int32_t status = usub_check_inputs(driver, call, index, p);
  if (status)
    return status;
  status = usub_penalty_update(&input, ask, &q, set->tangent || set->temperature_tangent, &out);
  if (!status)
    return keep_point(driver, call, at, index, p, &out);
  if (call->status && call->failed_point == p)
    return status; /* `ask` has said why */
  return usub_block_fail(driver, call, index, p, status,
                         "FRIC_COEF: %s (fCoef %g, pressure %g) at point %d",
                         usub_status_text(status), q.mu, at->pressure[i], p);
}

void usub_penalty_open_point(usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  memset(driver->last.trial_elastic + i * F, 0, F * sizeof(double));
  driver->last.trial_equivalent[i] = at->equivalent_slip[i];
  at->coefficient[2 * i] = at->coefficient[2 * i + 1] = 0;
}
