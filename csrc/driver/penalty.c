/* SPDX-License-Identifier: MIT */
/* Penalty enforcement of a friction coefficient; the model stands in penalty.h. */
#include "penalty.h"

#include <float.h>
#include <math.h>

#include "axes.h"
#include "usersub/status.h"

/* Bisection, which is a third of the trials, needs 11 halvings of the exponent and 53 of the
 * fraction at most: this bound is not reached. */
#define MOST_TRIALS 240
#define FIXED_POINT_TRIALS 8

/* Columns of d_mu. */
enum {
  BY_RATE,
  BY_PRESSURE,
  BY_TEMPERATURE,
  BY_RATE_1,
  BY_RATE_2,
  BY_EQUIVALENT,
  BY_SLIP_1,
  BY_SLIP_2
};

/* One point on its way to a solution. */
typedef struct point {
  const usub_penalty_input *input;
  usub_friction_fn friction;
  void *context;
  int32_t anisotropic; /* and two directions */
  int32_t want_tangent;
  int32_t frictionless[2]; /* direction whose whole motion is plastic */
  double g[2];             /* elastic predictor */
  /* Of the last trial: */
  double plastic[2];
  double length; /* of the plastic slip */
  usub_friction_value value;
  double a[2];   /* mu_i over the mean */
  double mean;   /* of the coefficients */
  double scaled; /* |g~| with these a */
  /* Of the solution: */
  int32_t slips;
  double excess; /* |g~| - c, 0 if not slipping */
  double size;   /* |g~| in slip, c in stick: what the stress is scaled by */
} point;

/* The four things that everything is differentiated by. */
enum { GAMMA_1, GAMMA_2, PRESSURE, TEMPERATURE, VARIABLES };

static int32_t check_input(const usub_penalty_input *in) {
  if ((in->directions != 1 && in->directions != 2) || !(in->time_increment >= 0.0) ||
      !(in->critical_elastic_slip > 0.0) || !(in->shear_limit >= 0.0) ||
      !isfinite(in->time_increment) || !isfinite(in->critical_elastic_slip)) {
    return USUB_BAD_ARGUMENT;
  }
  /* An infinite shear limit is a limit that is never reached. */
  double sum = fabs(in->pressure) * 0.0 + in->equivalent_slip * 0.0;
  for (int32_t i = 0; i < in->directions; ++i) {
    sum += (in->elastic_slip[i] + in->slip_increment[i]) * 0.0 + in->slip[i] * 0.0;
  }
  return sum == 0.0 ? USUB_OK : USUB_BAD_INPUT;
}

static int32_t check_value(const point *p) {
  for (int32_t k = 0; k <= p->anisotropic; ++k) {
    if (!isfinite(p->value.mu[k])) {
      return USUB_NOT_FINITE;
    }
    if (p->value.mu[k] < 0.0) {
      return USUB_CONTRACT;
    }
    for (int32_t i = 0; i < 8 && p->want_tangent; ++i) {
      if (!isfinite(p->value.d_mu[k][i])) {
        return USUB_NOT_FINITE;
      }
    }
  }
  return USUB_OK;
}

/* Slip rate that goes to the routine: finite whatever the time increment. */
static double rate_of(double slip, double time_increment) {
  if (time_increment == 0.0) {
    return 0.0;
  }
  const double rate = slip / time_increment;
  return fabs(rate) <= DBL_MAX ? rate : copysign(DBL_MAX, rate);
}

/* Asks for the coefficients at an excess |g~| - c and finds the |g~| that they make. */
static int32_t try_excess(point *p, double excess) {
  const usub_penalty_input *in = p->input;
  const double fraction = excess / (in->critical_elastic_slip + excess);
  for (int32_t i = 0; i < 2; ++i) {
    p->plastic[i] = p->frictionless[i] ? p->g[i] : fraction * p->g[i];
  }
  p->length = usub_norm2_d(p->plastic[0], p->plastic[1]);
  const int32_t two = in->directions == 2;
  const double slip_data[6] = {rate_of(p->length, in->time_increment),
                               rate_of(p->plastic[0], in->time_increment),
                               rate_of(p->plastic[1], in->time_increment),
                               in->equivalent_slip + p->length,
                               in->slip[0] + p->plastic[0],
                               two ? in->slip[1] + p->plastic[1] : 0.0};
  if (!isfinite(slip_data[3]) || !isfinite(slip_data[4]) || !isfinite(slip_data[5])) {
    return USUB_BAD_INPUT;
  }
  int32_t status = p->friction(p->context, slip_data, &p->value);
  if (status == USUB_OK) {
    status = check_value(p);
  }
  if (status != USUB_OK) {
    return status;
  }
  const double *mu = p->value.mu;
  p->a[0] = p->a[1] = 1.0;
  p->mean = mu[0];
  if (p->anisotropic) {
    p->mean = 0.5 * mu[0] + 0.5 * mu[1];
    const int32_t large = mu[1] > mu[0];
    if (mu[large] > 0.0) {
      const double ratio = mu[1 - large] / mu[large];
      p->a[large] = 2.0 / (1.0 + ratio);
      p->a[1 - large] = ratio * p->a[large];
    }
  }
  p->scaled = usub_norm2_d(p->a[0] * p->g[0], p->a[1] * p->g[1]);
  return isfinite(p->scaled) ? USUB_OK : USUB_BAD_INPUT;
}

/* Middle of a bracket of excesses: geometric in c + excess as long as its ends are far apart. */
static double middle(double c, double low, double high) {
  if (c + high > 4.0 * (c + low)) {
    return fmin(fmax(sqrt(c + low) * sqrt(c + high) - c, low), high);
  }
  return low + 0.5 * (high - low);
}

/* Finds the excess e = max(0, |g~(mu(e))| - c). As a_1 + a_2 = 2, |g~| is at most twice the larger
 * |g_i|: the solution is bracketed before the first trial. Fixed-point steps, growing, until the
 * other end is known, then false position (Illinois) with every third step a bisection. */
static int32_t solve_excess(point *p) {
  const double c = p->input->critical_elastic_slip;
  double low = 0.0, high = 2.0 * fmax(fabs(p->g[0]), fabs(p->g[1])) - c;
  double f_low = 0.0, f_high = 0.0, growth = 1.0, e = 0.0;
  int32_t side = 0;
  if (!isfinite(c + high)) {
    return USUB_BAD_INPUT;
  }
  for (int32_t trial = 0; trial < MOST_TRIALS; ++trial) {
    p->excess = e;
    const int32_t status = try_excess(p, e);
    if (status != USUB_OK) {
      return status;
    }
    const double f = fmax(0.0, p->scaled - c) - e;
    const double rounding = 4.0 * DBL_EPSILON * (c + e);
    if ((e == 0.0 && f == 0.0) || (e > 0.0 && fabs(f) <= rounding)) {
      return USUB_OK;
    }
    if (f > 0.0) {
      f_high *= side > 0 ? 0.5 : 1.0;
      low = e;
      f_low = f;
      side = 1;
    } else {
      f_low *= side < 0 ? 0.5 : 1.0;
      high = e;
      f_high = f;
      side = -1;
    }
    if (high - low <= rounding) {
      return USUB_OK;
    }
    if (f_high == 0.0) {
      e = trial < FIXED_POINT_TRIALS ? fmin(low + growth * f_low, high) : high;
      growth *= 2.0;
    } else {
      e = low + (high - low) * (f_low / (f_low - f_high));
      if (trial % 3 == 2 || !(e > low && e < high)) {
        e = middle(c, low, high);
      }
    }
  }
  return USUB_OK;
}

/* Slip and coefficients of the end of the increment. */
static int32_t solve(point *p) {
  if (!p->anisotropic) {
    const double size = usub_norm2_d(p->g[0], p->g[1]);
    p->excess = fmax(0.0, size - p->input->critical_elastic_slip);
    return isfinite(size) ? try_excess(p, p->excess) : USUB_BAD_INPUT;
  }
  const double *mu = p->value.mu;
  int32_t status = solve_excess(p);
  const int32_t i = mu[0] == 0.0 ? 0 : 1;
  if (status != USUB_OK || mu[i] != 0.0 || mu[1 - i] == 0.0 || p->g[i] == 0.0) {
    return status;
  }
  p->frictionless[i] = 1;
  status = solve_excess(p);
  if (status == USUB_OK && (mu[i] != 0.0 || mu[1 - i] == 0.0)) {
    /* Zero only while this direction does not slide: then it does not. */
    p->frictionless[i] = 0;
    status = solve_excess(p);
  }
  return status;
}

/* Derivatives of the coefficients by the plastic slip, d_mu/d_plastic, and the rest as they are. */
static void slip_derivatives(const point *p, double by_plastic[2][2]) {
  const double dt = p->input->time_increment;
  double unit[2] = {0.0, 0.0};
  if (p->length > 0.0) {
    unit[0] = p->plastic[0] / p->length;
    unit[1] = p->plastic[1] / p->length;
  }
  for (int32_t k = 0; k <= p->anisotropic; ++k) {
    const double *d = p->value.d_mu[k];
    for (int32_t j = 0; j < 2; ++j) {
      const double by_rate = d[BY_RATE] * unit[j] + d[BY_RATE_1 + j];
      by_plastic[k][j] = d[BY_EQUIVALENT] * unit[j] + d[BY_SLIP_1 + j];
      if (by_rate != 0.0 && dt > 0.0) {
        by_plastic[k][j] += by_rate / dt;
      }
    }
  }
}

/* Derivative of a_1 = 2 - a_2 when the coefficients change by d1 and d2. */
static double ratio_derivative(const point *p, double d1, double d2) {
  if (!p->anisotropic || p->mean == 0.0) {
    return 0.0;
  }
  return 0.5 * (p->a[1] * d1 - p->a[0] * d2) / p->mean;
}

/* Total derivatives of the coefficients, and in da of a_1. The excess depends on the coefficients,
 * which depend on the excess: one linear equation. */
static void total_derivatives(const point *p, const double n[2], double d_mu[2][VARIABLES],
                              double da[VARIABLES]) {
  const double c = p->input->critical_elastic_slip, whole = c + p->excess;
  double by_plastic[2][2] = {{0.0, 0.0}, {0.0, 0.0}}, by_excess[2] = {0.0, 0.0};
  slip_derivatives(p, by_plastic);
  for (int32_t k = 0; k <= p->anisotropic; ++k) {
    for (int32_t j = 0; j < 2; ++j) {
      const int32_t free = p->frictionless[j];
      d_mu[k][GAMMA_1 + j] = by_plastic[k][j] * (free ? 1.0 : p->excess / whole);
      by_excess[k] += free ? 0.0 : by_plastic[k][j] * (p->g[j] / whole) * (c / whole);
    }
    d_mu[k][PRESSURE] = p->value.d_mu[k][BY_PRESSURE];
    d_mu[k][TEMPERATURE] = p->value.d_mu[k][BY_TEMPERATURE];
  }
  const double by_a = n[0] * p->g[0] - n[1] * p->g[1];
  const double divisor = 1.0 - by_a * ratio_derivative(p, by_excess[0], by_excess[1]);
  for (int32_t x = 0; x < VARIABLES; ++x) {
    if (p->slips) {
      double d_excess = by_a * ratio_derivative(p, d_mu[0][x], d_mu[1][x]);
      d_excess += x <= GAMMA_2 ? n[x] * p->a[x] : 0.0;
      /* On a fold the excess has no derivative: leave its reaction on itself out. */
      d_excess /= divisor > 0.0 ? divisor : 1.0;
      d_mu[0][x] += by_excess[0] * d_excess;
      d_mu[1][x] += by_excess[1] * d_excess;
    }
    da[x] = ratio_derivative(p, d_mu[0][x], d_mu[1][x]);
  }
}

/* Derivatives of tau_i = limit a_i n_i, n the scaled predictor over its size (or c in stick). */
static void tangent(const point *p, double limit, int32_t on_coefficient,
                    usub_penalty_output *out) {
  const double n[2] = {p->a[0] * p->g[0] / p->size, p->a[1] * p->g[1] / p->size};
  double d_mu[2][VARIABLES] = {{0.0}}, da[VARIABLES] = {0.0};
  total_derivatives(p, n, d_mu, da);
  for (int32_t x = 0; x < VARIABLES; ++x) {
    double d_limit = 0.0;
    if (on_coefficient) {
      const double d_mean = p->anisotropic ? 0.5 * d_mu[0][x] + 0.5 * d_mu[1][x] : d_mu[0][x];
      d_limit = p->input->pressure * d_mean + (x == PRESSURE ? p->mean : 0.0);
    }
    const double d_scaled[2] = {(x == GAMMA_1 ? p->a[0] : 0.0) + p->g[0] * da[x],
                                (x == GAMMA_2 ? p->a[1] : 0.0) - p->g[1] * da[x]};
    /* In slip only the part across n turns it; written as that part, nothing cancels. */
    const double across = n[0] * d_scaled[1] - n[1] * d_scaled[0];
    const double d_n[2] = {p->slips ? -n[1] * across : d_scaled[0],
                           p->slips ? n[0] * across : d_scaled[1]};
    for (int32_t i = 0; i < p->input->directions; ++i) {
      const double d_a = i == 0 ? da[x] : -da[x];
      const double d_tau = usub_product_quotient(p->a[i] * limit, d_n[i], p->size) +
                           limit * d_a * n[i] + p->a[i] * n[i] * d_limit;
      if (x <= GAMMA_2) {
        out->d_tau_d_gamma[i][x] = x < p->input->directions ? d_tau : 0.0;
      } else if (x == PRESSURE) {
        out->d_tau_d_pressure[i] = d_tau;
      } else {
        out->d_tau_d_temperature[i] = d_tau;
      }
    }
  }
}

int32_t usub_penalty_update(const usub_penalty_input *input, usub_friction_fn friction,
                            void *context, int32_t want_tangent, usub_penalty_output *output) {
  int32_t status = check_input(input);
  if (status != USUB_OK) {
    return status;
  }
  const int32_t two = input->directions == 2;
  point p = {.input = input,
             .friction = friction,
             .context = context,
             .anisotropic = input->anisotropic && two,
             .want_tangent = want_tangent,
             .g = {input->elastic_slip[0] + input->slip_increment[0],
                   two ? input->elastic_slip[1] + input->slip_increment[1] : 0.0}};
  status = solve(&p);
  if (status != USUB_OK) {
    return status;
  }
  /* At a jump of the coefficients |g~| need not fit the excess, and can even be zero. */
  p.slips = p.excess > 0.0 && p.scaled > 0.0;
  p.size = p.slips ? p.scaled : input->critical_elastic_slip;
  /* The stress is min(m p, limit); a product that overflows is above any limit. */
  double limit = input->pressure > 0.0 ? p.mean * input->pressure : 0.0;
  int32_t on_coefficient = input->pressure >= 0.0;
  if (input->shear_limit > 0.0 && limit > input->shear_limit) {
    limit = input->shear_limit;
    on_coefficient = 0;
  }
  if (!isfinite(limit)) {
    return USUB_NOT_FINITE;
  }
  *output = (usub_penalty_output){.mu = {p.value.mu[0], p.value.mu[p.anisotropic]}};
  output->equivalent_slip_increment = p.length;
  output->sticks = p.length == 0.0;
  const double c = input->critical_elastic_slip, elastic = c / (c + p.excess);
  for (int32_t i = 0; i < input->directions; ++i) {
    output->tau[i] = usub_product_quotient(p.a[i] * limit, p.a[i] * p.g[i], p.size);
    output->slip_increment_plastic[i] = p.plastic[i];
    output->elastic_slip[i] = p.frictionless[i] ? 0.0 : elastic * p.g[i];
    output->sed += 0.5 * output->tau[i] * output->elastic_slip[i];
    output->sfd += output->tau[i] * output->slip_increment_plastic[i];
  }
  if (want_tangent) {
    tangent(&p, limit, on_coefficient, output);
  }
  return USUB_OK;
}
