/* SPDX-License-Identifier: MIT */
/* FRIC_COEF in a standard driver: the routine gives coefficients, penalty.c or lagrange.c enforces
 * them.
 *
 * The routine is called with nBlock = 1, in the layout of its generation; a routine of unknown
 * generation gets the 2022 layout, of which the legacy one is a part at nBlock = 1. */
#include "penalty.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fric_coef.h"
#include "lagrange.h"
#include "standard.h"

/* How it is enforced, for the plan. */
static const char *method_of(const usub_driver *driver) {
  if (driver->enforcement == USUB_ENFORCE_LAGRANGE)
    return "enforced by Lagrange multipliers";
  return driver->set.stick_slope > 0 ? "enforced with a stick slope"
                                     : "enforced by the penalty method";
}

void usub_fric_coef_plan(usub_driver *driver) {
  const size_t real = sizeof(double), fields = (size_t)driver->size.P * real;
  static const char mean[] = "mean of the two surfaces";
  usub_put_coefficient_common(driver);
  usub_put_scratch(driver, USUB_COEF, 0, 2 * real, "output", method_of(driver));
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
  if (driver->enforcement == USUB_ENFORCE_LAGRANGE && !usub_data(driver, "multiplier"))
    snprintf(driver->missing, sizeof driver->missing,
             "FRIC_COEF: array 'multiplier' is not bound; scene setting 'enforcement' = 'lagrange' "
             "needs it");
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
  double mu[2]; /* the last answer */
} question;

/* The answer of the routine where friction changes: on the way to it from the start of the step.
 * What the routine would be at the end of the step it is estimated to be now. */
static int32_t change(const question *q, usub_friction_value *value) {
  usub_driver *driver = q->driver;
  const double by = driver->amplitude, *start = usub_start_coefficient(driver, q->at, q->point);
  for (int32_t m = 0; m <= driver->set.anisotropic; ++m) {
    if (value->mu[m] < 0)
      return USUB_CONTRACT;
    value->mu[m] = (1 - by) * start[m] + by * value->mu[m];
    for (int32_t j = 0; j < 8; ++j)
      value->d_mu[m][j] *= by;
  }
  return USUB_OK;
}

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
  if (status < 0 && usub_checked_fail(driver, call, q->index, q->point, status))
    return status;
  if (status < 0)
    return usub_block_fail(driver, call, q->index, q->point, status,
                           "FRIC_COEF: the routine ended with %s at point %d",
                           status == USUB_ROUTINE_RAISED ? "an exception" : "its status", q->point);
  status = usub_check_second(driver, call, q->index, q->point, coef[1]);
  if (status)
    return status;
  const int two = driver->set.anisotropic;
  memset(value, 0, sizeof *value);
  value->mu[0] = q->mu[0] = coef[0];
  value->mu[1] = q->mu[1] = coef[two];
  const int named = modern ? USUB_NAMED_DERIVATIVES : USUB_LEGACY_DERIVATIVES;
  for (int m = 0; differentiates && m < 2; ++m)
    for (int j = 0; j < named; ++j)
      value->d_mu[m][j] = deriv[two * m * USUB_DERIVATIVES + j];
  return driver->set.changing ? change(q, value) : USUB_OK;
}

/* Viscous stress of the slip of the increment; without time there is no velocity. */
static void add_damping(const usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const double dt = driver->clock.time[2];
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  if (!(driver->set.damping > 0) || !(dt > 0) || at->lm[p] == USUB_STICKING)
    return;
  const double rate = driver->set.damping / dt;
  for (size_t a = 0; a < F; ++a) {
    const double slip = at->slip_increment[i * F + a];
    at->tau[i * F + a] += rate * slip;
    at->sfd[i] += rate * slip * slip;
    if (at->ddtddg)
      at->ddtddg[(i * F + a) * F + a] += rate;
  }
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
  driver->last.by_pressure[p] = out->mu_by_pressure[0] != 0 || out->mu_by_pressure[1] != 0;
  driver->last.trial_equivalent[i] = at->equivalent_slip[i] + out->equivalent_slip_increment;
  at->sed[i] = out->sed;
  at->sfd[i] = out->sfd;
  at->coefficient[2 * i] = out->mu[0];
  at->coefficient[2 * i + 1] = out->mu[1];
  add_damping(driver, at, p);
  const int32_t status =
      usub_check_answers(driver, call, at, index, p, "the coefficients of the routine lead to");
  if (status || !S || !usub_is_2022(driver) || !usub_is_live(driver, USUB_RDATA))
    return status;
  const double *rdata = call->argv[USUB_RDATA];
  memcpy(driver->last.trial_state + i * S, rdata + USUB_RDATA_HEAD, S * sizeof(double));
  return usub_check_trial_state(driver, call, index, p);
}

/* A committed vector in the directions of now: they may have turned since. The turn may be NaN. */
static void turned(const usub_driver *driver, const usub_point_arrays *at, int32_t p,
                   const double *committed, double now[2]) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  const double old[2] = {committed[i * F], F == 2 ? committed[i * F + 1] : 0};
  memcpy(now, old, sizeof old);
  if (!at->rotation || F < 2)
    return;
  const double *turn = at->rotation + 4 * i;
  for (size_t a = 0; a < 2; ++a)
    now[a] = turn[a] * old[0] + turn[2 + a] * old[1];
}

static int32_t bad_turn(usub_driver *driver, usub_call *call, int32_t index, int32_t p,
                        const char *what, const double turned_to[2]) {
  return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                         "FRIC_COEF: rotation of point %d makes its %s %g; expected a rotation", p,
                         what, turned_to[0] + turned_to[1]);
}

/* The stress that decides between stick and slip: of the constraint, or of the last iteration. */
static int32_t find_stress(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p, int32_t lm, double stress[2]) {
  const usub_iteration *last = &driver->last;
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  stress[0] = stress[1] = 0;
  if (lm == USUB_STICKING) {
    memcpy(stress, at->multiplier + i * F, F * sizeof(double));
    if (usub_first_bad_of_few(stress, 2) < 0)
      return USUB_OK;
    return usub_block_fail(driver, call, index, p, USUB_BAD_INPUT,
                           "FRIC_COEF: multiplier of point %d is not finite, but the point sticks",
                           p);
  }
  if (lm == USUB_OPEN)
    return USUB_OK;
  if (last->done && last->closed[p]) {
    memcpy(stress, last->tau + i * F, F * sizeof(double));
    return USUB_OK;
  }
  turned(driver, at, p, at->committed_tau, stress);
  return usub_first_bad_of_few(stress, 2) < 0
             ? USUB_OK
             : bad_turn(driver, call, index, p, "friction stress", stress);
}

/* Coefficients that cannot be enforced, or lead to stresses that are no numbers. */
static int32_t bad_answer(const question *q, int32_t status) {
  char coefficients[64];
  const int32_t two = q->driver->set.anisotropic;
  snprintf(coefficients, sizeof coefficients, two ? "%g and %g" : "%g", q->mu[0], q->mu[1]);
  return usub_block_fail(q->driver, q->call, q->index, q->point, status,
                         "FRIC_COEF: %s (fCoef %s, pressure %g) at point %d",
                         usub_status_text(status), coefficients, q->at->pressure[q->point],
                         q->point);
}

/* Asks and enforces; `elastic` is the elastic slip at the start. */
static int32_t enforce(question *q, const double elastic[2], int32_t lm, const double stress[2],
                       usub_penalty_output *out) {
  const usub_driver *driver = q->driver;
  const usub_settings *set = &driver->set;
  const usub_point_arrays *at = q->at;
  const size_t F = (size_t)driver->size.F, i = (size_t)q->point;
  const int32_t want = set->tangent || set->temperature_tangent;
  const usub_penalty_input input = {
      .directions = driver->size.F,
      .anisotropic = set->anisotropic,
      .pressure = at->pressure[i],
      .time_increment = driver->clock.time[2],
      .critical_elastic_slip = usub_allowable_elastic_slip(driver, at, q->point),
      .stick_slope = set->stick_slope,
      .shear_limit = set->shear_limit,
      .elastic_slip = elastic,
      .slip = at->slip + i * F,
      .slip_increment = at->slip_increment + i * F,
      .equivalent_slip = at->equivalent_slip[i],
  };
  if (driver->enforcement != USUB_ENFORCE_LAGRANGE)
    return usub_penalty_update(&input, ask, q, want, out);
  /* A point that closes starts as one that sticks. */
  const int32_t status =
      usub_lagrange_update(&input, lm != USUB_SLIPPING, stress, ask, q, want, out);
  at->lm[i] = !status && out->sticks ? USUB_STICKING : USUB_SLIPPING;
  return status;
}

int32_t usub_fric_coef_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                             int32_t index, int32_t p) {
  const int32_t lagrange = driver->enforcement == USUB_ENFORCE_LAGRANGE;
  const int32_t lm = usub_lm_on_entry(driver, at, p);
  double elastic[2] = {0, 0}, stress[2] = {0, 0};
  int32_t status = USUB_OK;
  if (lagrange) {
    status = find_stress(driver, call, at, index, p, lm, stress);
  } else {
    turned(driver, at, p, at->elastic_slip, elastic);
    if (usub_first_bad_of_few(elastic, 2) >= 0)
      status = bad_turn(driver, call, index, p, "elastic slip", elastic);
  }
  if (status)
    return status;
  question q = {driver, call, at, index, p, {0, 0}};
  usub_penalty_output out;
  fill_point(driver, call, at, p);
  at->lm[p] = USUB_SLIPPING;
  status = usub_check_inputs(driver, call, index, p);
  if (status)
    return status;
  status = enforce(&q, elastic, lm, stress, &out);
  if (!status)
    return keep_point(driver, call, at, index, p, &out);
  if (call->status && call->failed_point == p)
    return status; /* `ask` has said why */
  return bad_answer(&q, status);
}

void usub_fric_coef_open_point(usub_driver *driver, const usub_point_arrays *at, int32_t p) {
  const size_t F = (size_t)driver->size.F, i = (size_t)p;
  memset(driver->last.trial_elastic + i * F, 0, F * sizeof(double));
  driver->last.trial_equivalent[i] = at->equivalent_slip[i];
  driver->last.by_pressure[p] = 0;
  at->coefficient[2 * i] = at->coefficient[2 * i + 1] = 0;
}
