/* SPDX-License-Identifier: MIT */
/* What the coefficients make of a plastic slip at one contact point. */
#include "trial.h"

#include <float.h>
#include <math.h>

#include "axes.h"
#include "usersub/status.h"

static int32_t check_input(const usub_penalty_input *in) {
  if ((in->directions != 1 && in->directions != 2) || !(in->time_increment >= 0.0) ||
      !(in->critical_elastic_slip >= 0.0) || !(in->stick_slope >= 0.0) ||
      !(in->shear_limit >= 0.0) || !isfinite(in->time_increment) ||
      !isfinite(in->critical_elastic_slip) || !isfinite(in->stick_slope)) {
    return USUB_BAD_ARGUMENT;
  }
  /* An infinite shear limit is a limit that is never reached. */
  double sum = fabs(in->pressure) * 0.0 + in->equivalent_slip * 0.0;
  for (int32_t i = 0; i < in->directions; ++i) {
    sum += (in->elastic_slip[i] + in->slip_increment[i]) * 0.0 + in->slip[i] * 0.0;
  }
  return sum == 0.0 ? USUB_OK : USUB_BAD_INPUT;
}

int32_t usub_trial_start(usub_trial *trial, const usub_penalty_input *input,
                         usub_friction_fn friction, void *context, int32_t want_tangent) {
  const int32_t status = check_input(input);
  if (status != USUB_OK) {
    return status;
  }
  const int32_t two = input->directions == 2;
  *trial = (usub_trial){.input = input,
                        .friction = friction,
                        .context = context,
                        .anisotropic = input->anisotropic && two,
                        .want_tangent = want_tangent,
                        .g = {input->elastic_slip[0] + input->slip_increment[0],
                              two ? input->elastic_slip[1] + input->slip_increment[1] : 0.0}};
  return USUB_OK;
}

static int32_t check_value(const usub_trial *trial) {
  for (int32_t k = 0; k <= trial->anisotropic; ++k) {
    if (!isfinite(trial->value.mu[k])) {
      return USUB_NOT_FINITE;
    }
    if (trial->value.mu[k] < 0.0) {
      return USUB_CONTRACT;
    }
    for (int32_t i = 0; i < 8 && trial->want_tangent; ++i) {
      if (!isfinite(trial->value.d_mu[k][i])) {
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

/* Mean, ratios and strength of the coefficients that were answered. */
static void take_value(usub_trial *trial) {
  const usub_penalty_input *in = trial->input;
  const double *mu = trial->value.mu;
  trial->a[0] = trial->a[1] = 1.0;
  trial->mean = mu[0];
  if (trial->anisotropic) {
    trial->mean = 0.5 * mu[0] + 0.5 * mu[1];
    const int32_t large = mu[1] > mu[0];
    if (mu[large] > 0.0) {
      const double ratio = mu[1 - large] / mu[large];
      trial->a[large] = 2.0 / (1.0 + ratio);
      trial->a[1 - large] = ratio * trial->a[large];
    }
  }
  /* The strength is min(m p, limit); a product that overflows is above any limit. */
  trial->strength = in->pressure > 0.0 ? trial->mean * in->pressure : 0.0;
  /* An elastic slip below the smallest normal number has no digits: it carries nothing. */
  if (in->stick_slope > 0.0 && trial->strength < in->stick_slope * DBL_MIN) {
    trial->strength = 0.0;
  }
  trial->on_coefficient = in->pressure >= 0.0;
  if (in->shear_limit > 0.0 && trial->strength > in->shear_limit) {
    trial->strength = in->shear_limit;
    trial->on_coefficient = 0;
  }
}

int32_t usub_trial_ask(usub_trial *trial, double fraction) {
  const usub_penalty_input *in = trial->input;
  for (int32_t i = 0; i < 2; ++i) {
    trial->plastic[i] = trial->frictionless[i] ? trial->g[i] : fraction * trial->g[i];
  }
  trial->length = usub_norm2_d(trial->plastic[0], trial->plastic[1]);
  const int32_t two = in->directions == 2;
  const double slip_data[6] = {rate_of(trial->length, in->time_increment),
                               rate_of(trial->plastic[0], in->time_increment),
                               rate_of(trial->plastic[1], in->time_increment),
                               in->equivalent_slip + trial->length,
                               in->slip[0] + trial->plastic[0],
                               two ? in->slip[1] + trial->plastic[1] : 0.0};
  if (!isfinite(slip_data[3]) || !isfinite(slip_data[4]) || !isfinite(slip_data[5])) {
    return USUB_BAD_INPUT;
  }
  int32_t status = trial->friction(trial->context, slip_data, &trial->value);
  if (status == USUB_OK) {
    status = check_value(trial);
  }
  if (status != USUB_OK) {
    return status;
  }
  take_value(trial);
  trial->scaled = usub_norm2_d(trial->a[0] * trial->g[0], trial->a[1] * trial->g[1]);
  return isfinite(trial->scaled) ? USUB_OK : USUB_BAD_INPUT;
}

void usub_trial_by_slip(const usub_trial *trial, const double unit[2], double by_plastic[2][2]) {
  const double dt = trial->input->time_increment;
  for (int32_t k = 0; k < 2; ++k) {
    const double *d = trial->value.d_mu[k];
    by_plastic[k][0] = by_plastic[k][1] = 0.0;
    for (int32_t j = 0; j < 2 && k <= trial->anisotropic; ++j) {
      const double by_rate = d[USUB_BY_RATE] * unit[j] + d[USUB_BY_RATE_1 + j];
      by_plastic[k][j] = d[USUB_BY_EQUIVALENT] * unit[j] + d[USUB_BY_SLIP_1 + j];
      if (by_rate != 0.0 && dt > 0.0) {
        by_plastic[k][j] += by_rate / dt;
      }
    }
  }
}

double usub_trial_ratio(const usub_trial *trial, double d1, double d2) {
  if (!trial->anisotropic || trial->mean == 0.0) {
    return 0.0;
  }
  return 0.5 * (trial->a[1] * d1 - trial->a[0] * d2) / trial->mean;
}

double usub_trial_strength(const usub_trial *trial, double d1, double d2) {
  if (!trial->on_coefficient) {
    return 0.0;
  }
  return trial->input->pressure * (trial->anisotropic ? 0.5 * d1 + 0.5 * d2 : d1);
}
