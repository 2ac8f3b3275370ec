/* SPDX-License-Identifier: MIT */
/* Penalty enforcement of a friction coefficient; the model stands in penalty.h. */
#include "penalty.h"

#include <float.h>
#include <math.h>

#include "axes.h"
#include "trial.h"
#include "usersub/status.h"

/* Bisection, which is a third of the trials, needs 53 halvings at most: this is not reached. */
#define MOST_TRIALS 240
#define FIXED_POINT_TRIALS 8
/* An elastic slip that was left at the critical one is rounded: at rest it must not slip again. */
#define ROUNDED (1.0 + 4.0 * DBL_EPSILON)

/* What fraction of the predictor is plastic, and the stress a_i force (a_i g_i / size) of it. */
typedef struct solution {
  usub_trial trial;
  double fraction; /* plastic */
  double elastic;  /* the rest */
  int32_t slips;
  int32_t softened; /* sticks with the stick slope */
  double critical;  /* allowable elastic slip */
  double force, size;
} solution;

/* Allowable elastic slip with the strength of the last question. */
static double critical_of(const usub_trial *trial) {
  const usub_penalty_input *in = trial->input;
  return in->stick_slope > 0.0 ? trial->strength / in->stick_slope : in->critical_elastic_slip;
}

/* The fraction that the coefficients of the last question make plastic. */
static double made_plastic(const usub_trial *trial) {
  const double critical = critical_of(trial);
  return trial->scaled > critical * ROUNDED ? (trial->scaled - critical) / trial->scaled : 0.0;
}

/* Takes `fraction`; what remains elastic is told by the coefficients if they agree with it. */
static int32_t accept(solution *s, double fraction, int32_t agreed) {
  s->fraction = fraction;
  s->critical = critical_of(&s->trial);
  const int32_t told = agreed && fraction > 0.0 && s->trial.scaled > s->critical;
  s->elastic = told ? s->critical / s->trial.scaled : 1.0 - fraction;
  return USUB_OK;
}

/* Finds the fraction x = made_plastic(mu(x)). It is bracketed by 0 and 1 before the first trial.
 * Fixed-point steps, growing, until the other end is known, then false position (Illinois) with
 * every third step a bisection. */
static int32_t solve_fraction(solution *s) {
  const double rounding = 4.0 * DBL_EPSILON;
  double low = 0.0, high = 1.0, f_low = 0.0, f_high = 0.0, growth = 1.0, x = 0.0;
  int32_t side = 0;
  for (int32_t trial = 0; trial < MOST_TRIALS; ++trial) {
    const int32_t status = usub_trial_ask(&s->trial, x);
    if (status != USUB_OK) {
      return status;
    }
    const double f = made_plastic(&s->trial) - x;
    if ((x == 0.0 && f == 0.0) || (x > 0.0 && fabs(f) <= rounding)) {
      return accept(s, x, 1);
    }
    if (f > 0.0) {
      f_high *= side > 0 ? 0.5 : 1.0;
      low = x;
      f_low = f;
      side = 1;
    } else {
      f_low *= side < 0 ? 0.5 : 1.0;
      high = x;
      f_high = f;
      side = -1;
    }
    if (high - low <= rounding) {
      return accept(s, x, 0);
    }
    if (f_high == 0.0) {
      x = trial < FIXED_POINT_TRIALS ? fmin(low + growth * f_low, high) : high;
      growth *= 2.0;
    } else {
      x = low + (high - low) * (f_low / (f_low - f_high));
      if (trial % 3 == 2 || !(x > low && x < high)) {
        x = low + 0.5 * (high - low);
      }
    }
  }
  return accept(s, x, 0);
}

/* Slip and coefficients of the end of the increment. */
static int32_t solve(solution *s) {
  usub_trial *trial = &s->trial;
  const usub_penalty_input *in = trial->input;
  if (!(in->stick_slope > 0.0) && (!trial->anisotropic || in->critical_elastic_slip == 0.0)) {
    trial->scaled = usub_norm2_d(trial->g[0], trial->g[1]);
    const double x = in->critical_elastic_slip == 0.0 ? 1.0 : made_plastic(trial);
    const int32_t status = isfinite(trial->scaled) ? usub_trial_ask(trial, x) : USUB_BAD_INPUT;
    return status != USUB_OK ? status : accept(s, x, 1);
  }
  const double *mu = trial->value.mu;
  int32_t status = solve_fraction(s);
  const int32_t i = mu[0] == 0.0 ? 0 : 1;
  if (status != USUB_OK || !trial->anisotropic || mu[i] != 0.0 || mu[1 - i] == 0.0 ||
      trial->g[i] == 0.0) {
    return status;
  }
  trial->frictionless[i] = 1;
  status = solve_fraction(s);
  if (status == USUB_OK && (mu[i] != 0.0 || mu[1 - i] == 0.0)) {
    /* Zero only while this direction does not slide: then it does not. */
    trial->frictionless[i] = 0;
    status = solve_fraction(s);
  }
  return status;
}

/* The stress, as force over size. */
static void find_force(solution *s) {
  const usub_trial *trial = &s->trial;
  /* At a jump of the coefficients |g~| need not fit the fraction, and can even be zero. */
  s->slips = s->fraction > 0.0 && trial->scaled > 0.0;
  s->softened = !s->slips && trial->input->stick_slope > 0.0;
  s->force = s->softened && trial->strength > 0.0 ? trial->input->stick_slope : trial->strength;
  const int32_t at_limit = s->critical > 0.0 && trial->scaled > s->critical;
  s->size = s->slips || at_limit ? trial->scaled : s->critical;
  if (s->softened && at_limit) {
    s->force = trial->strength;
  } else if (s->softened || !(s->size > 0.0)) {
    s->size = 1.0;
  }
}

/* Total derivatives of the coefficients, and in da of a_1. The plastic fraction depends on the
 * coefficients, which depend on it: one linear equation, for |g~| times its derivative. */
static void total_derivatives(const solution *s, const double n[2], double d_mu[2][USUB_VARIABLES],
                              double da[USUB_VARIABLES]) {
  const usub_trial *p = &s->trial;
  double unit[2] = {0.0, 0.0}, by_plastic[2][2], by_fraction[2] = {0.0, 0.0};
  if (p->length > 0.0) {
    unit[0] = p->plastic[0] / p->length;
    unit[1] = p->plastic[1] / p->length;
  }
  usub_trial_by_slip(p, unit, by_plastic);
  for (int32_t k = 0; k <= p->anisotropic; ++k) {
    for (int32_t j = 0; j < 2; ++j) {
      const int32_t free = p->frictionless[j];
      d_mu[k][USUB_GAMMA_1 + j] = by_plastic[k][j] * (free ? 1.0 : s->fraction);
      by_fraction[k] += free || !s->slips ? 0.0 : by_plastic[k][j] * (p->g[j] / s->size);
    }
    d_mu[k][USUB_PRESSURE_OF] = p->value.d_mu[k][USUB_BY_PRESSURE];
    d_mu[k][USUB_TEMPERATURE_OF] = p->value.d_mu[k][USUB_BY_TEMPERATURE];
  }
  const double slope = p->input->stick_slope, give = slope > 0.0 ? 1.0 / slope : 0.0;
  const double by_a = n[0] * p->g[0] - n[1] * p->g[1];
  const double by_ratio = s->elastic * by_a;
  const double divisor = 1.0 - by_ratio * usub_trial_ratio(p, by_fraction[0], by_fraction[1]) +
                         give * usub_trial_strength(p, by_fraction[0], by_fraction[1]);
  for (int32_t x = 0; x < USUB_VARIABLES; ++x) {
    if (s->slips) {
      double d = by_ratio * usub_trial_ratio(p, d_mu[0][x], d_mu[1][x]) -
                 give * usub_trial_strength(p, d_mu[0][x], d_mu[1][x]);
      d += x <= USUB_GAMMA_2 ? s->elastic * n[x] * p->a[x] : 0.0;
      d -= x == USUB_PRESSURE_OF && p->on_coefficient ? give * p->mean : 0.0;
      /* On a fold the fraction has no derivative: leave its reaction on itself out. */
      d /= divisor > 0.0 ? divisor : 1.0;
      d_mu[0][x] += by_fraction[0] * d;
      d_mu[1][x] += by_fraction[1] * d;
    }
    da[x] = usub_trial_ratio(p, d_mu[0][x], d_mu[1][x]);
  }
}

/* Derivatives of tau_i = force a_i n_i, n the scaled predictor over its size. */
static void tangent(const solution *s, usub_penalty_output *out) {
  const usub_trial *p = &s->trial;
  const double n[2] = {p->a[0] * p->g[0] / s->size, p->a[1] * p->g[1] / s->size};
  double d_mu[2][USUB_VARIABLES] = {{0.0}}, da[USUB_VARIABLES] = {0.0};
  total_derivatives(s, n, d_mu, da);
  for (int32_t x = 0; x < USUB_VARIABLES; ++x) {
    double d_force = 0.0;
    if (!s->softened) {
      d_force = usub_trial_strength(p, d_mu[0][x], d_mu[1][x]);
      d_force += x == USUB_PRESSURE_OF && p->on_coefficient ? p->mean : 0.0;
    }
    const double d_scaled[2] = {(x == USUB_GAMMA_1 ? p->a[0] : 0.0) + p->g[0] * da[x],
                                (x == USUB_GAMMA_2 ? p->a[1] : 0.0) - p->g[1] * da[x]};
    /* In slip only the part across n turns it; written as that part, nothing cancels. */
    const double across = n[0] * d_scaled[1] - n[1] * d_scaled[0];
    const double d_n[2] = {s->slips ? -n[1] * across : d_scaled[0],
                           s->slips ? n[0] * across : d_scaled[1]};
    for (int32_t i = 0; i < p->input->directions; ++i) {
      const double d_a = i == 0 ? da[x] : -da[x];
      const double d_tau = usub_product_quotient(p->a[i] * s->force, d_n[i], s->size) +
                           s->force * d_a * n[i] + p->a[i] * n[i] * d_force;
      if (x <= USUB_GAMMA_2) {
        out->d_tau_d_gamma[i][x] = x < p->input->directions ? d_tau : 0.0;
      } else if (x == USUB_PRESSURE_OF) {
        out->d_tau_d_pressure[i] = d_tau;
      } else {
        out->d_tau_d_temperature[i] = d_tau;
      }
    }
  }
}

void usub_penalty_answers(const usub_trial *trial, usub_penalty_output *output) {
  const int32_t second = trial->anisotropic;
  *output = (usub_penalty_output){.mu = {trial->value.mu[0], trial->value.mu[second]}};
  output->mu_by_pressure[0] = trial->value.d_mu[0][USUB_BY_PRESSURE];
  output->mu_by_pressure[1] = trial->value.d_mu[second][USUB_BY_PRESSURE];
  output->equivalent_slip_increment = trial->length;
}

int32_t usub_rigid_slip_update(const usub_penalty_input *input, usub_friction_fn friction,
                               void *context, int32_t want_tangent, usub_penalty_output *output) {
  solution s = {.fraction = 0.0};
  int32_t status = usub_trial_start(&s.trial, input, friction, context, want_tangent);
  if (status == USUB_OK) {
    status = solve(&s);
  }
  if (status != USUB_OK) {
    return status;
  }
  const usub_trial *p = &s.trial;
  if (!isfinite(p->strength)) {
    return USUB_NOT_FINITE;
  }
  find_force(&s);
  usub_penalty_answers(p, output);
  output->sticks = p->length == 0.0;
  for (int32_t i = 0; i < input->directions; ++i) {
    output->tau[i] = usub_product_quotient(p->a[i] * s.force, p->a[i] * p->g[i], s.size);
    output->slip_increment_plastic[i] = p->plastic[i];
    output->elastic_slip[i] = p->frictionless[i] ? 0.0 : s.elastic * p->g[i];
    output->sed += 0.5 * output->tau[i] * output->elastic_slip[i];
    output->sfd += output->tau[i] * output->slip_increment_plastic[i];
  }
  if (want_tangent) {
    tangent(&s, output);
  }
  return USUB_OK;
}

int32_t usub_penalty_update(const usub_penalty_input *input, usub_friction_fn friction,
                            void *context, int32_t want_tangent, usub_penalty_output *output) {
  if (!(input->stick_slope > 0.0) && !(input->critical_elastic_slip > 0.0)) {
    return USUB_BAD_ARGUMENT;
  }
  return usub_rigid_slip_update(input, friction, context, want_tangent, output);
}
