/* SPDX-License-Identifier: MIT */
/* Sticking by Lagrange multipliers; the rules stand in lagrange.h. */
#include "lagrange.h"

#include <math.h>

#include "axes.h"
#include "trial.h"
#include "usersub/status.h"

/* Over the strength, what a constraint stress in a frictionless direction may be: rounding of the
 * host's solver. */
#define NOTHING 1e-9

/* Whether a stress has a part in a frictionless direction, which nothing can hold. */
static int32_t is_beyond_holding(const usub_trial *p, const double stress[2]) {
  int32_t beyond = 0;
  for (int32_t i = 0; i < 2; ++i) {
    beyond |= p->a[i] == 0.0 && fabs(stress[i]) > NOTHING * p->strength;
  }
  return beyond;
}

/* A stress in scaled form, without its part in a frictionless direction. */
static double scaled_stress(const usub_trial *p, const double stress[2], double scaled[2]) {
  for (int32_t i = 0; i < 2; ++i) {
    scaled[i] = p->a[i] > 0.0 ? stress[i] / p->a[i] : 0.0;
  }
  return usub_norm2_d(scaled[0], scaled[1]);
}

/* Direction of the slip that a scaled stress of direction `n` drives. */
static void slip_direction(const usub_trial *p, const double n[2], double unit[2]) {
  for (int32_t i = 0; i < 2; ++i) {
    unit[i] = p->a[i] > 0.0 ? n[i] / p->a[i] : 0.0;
  }
  const double length = usub_norm2_d(unit[0], unit[1]);
  unit[0] /= length;
  unit[1] /= length;
}

/* The stiffness with which the stress turns, T/|a g| (A^2 - A^2 g g A^2 / |a g|^2), for a slip g of
 * the reference size in the direction `unit`. It keeps the first slip to that direction. */
static void add_turning(const usub_trial *p, const double n[2], const double unit[2],
                        double reference, usub_penalty_output *out) {
  const double size = usub_norm2_d(p->a[0] * unit[0], p->a[1] * unit[1]);
  const double whole = reference > 0.0 ? p->strength / reference / size : 0.0;
  const double across[2] = {-p->a[0] * n[1], p->a[1] * n[0]};
  for (int32_t i = 0; i < p->input->directions; ++i) {
    for (int32_t j = 0; j < p->input->directions && p->input->directions > 1; ++j) {
      out->d_tau_d_gamma[i][j] += whole * across[i] * across[j];
    }
  }
}

/* Derivatives of tau_i = a_i n_i T, where n is the scaled stress over its size and the stress
 * itself keeps its direction. */
static void tangent(const usub_trial *p, const double n[2], double reference,
                    usub_penalty_output *out) {
  double by_plastic[2][2], unit[2];
  slip_direction(p, n, unit);
  usub_trial_by_slip(p, unit, by_plastic);
  for (int32_t x = 0; x < USUB_VARIABLES; ++x) {
    double d_mu[2] = {0.0, 0.0};
    for (int32_t k = 0; k <= p->anisotropic; ++k) {
      d_mu[k] = x <= USUB_GAMMA_2       ? by_plastic[k][x]
                : x == USUB_PRESSURE_OF ? p->value.d_mu[k][USUB_BY_PRESSURE]
                                        : p->value.d_mu[k][USUB_BY_TEMPERATURE];
    }
    double d_strength = usub_trial_strength(p, d_mu[0], d_mu[1]);
    d_strength += x == USUB_PRESSURE_OF && p->on_coefficient ? p->mean : 0.0;
    /* |l~| grows as the a_i shrink: d|l~| / |l~| = - sum n_i^2 da_i / a_i, with da_2 = - da_1. */
    const double da = usub_trial_ratio(p, d_mu[0], d_mu[1]);
    double growth = p->a[0] > 0.0 ? -n[0] * n[0] * da / p->a[0] : 0.0;
    growth += p->a[1] > 0.0 ? n[1] * n[1] * da / p->a[1] : 0.0;
    for (int32_t i = 0; i < p->input->directions; ++i) {
      const double d_tau = p->a[i] * n[i] * (d_strength - p->strength * growth);
      if (x <= USUB_GAMMA_2) {
        out->d_tau_d_gamma[i][x] = x < p->input->directions ? d_tau : 0.0;
      } else if (x == USUB_PRESSURE_OF) {
        out->d_tau_d_pressure[i] = d_tau;
      } else {
        out->d_tau_d_temperature[i] = d_tau;
      }
    }
  }
  add_turning(p, n, unit, reference, out);
}

/* A stress that is scaled back, or up, to strength while there is no slip yet. */
static void hold_direction(const usub_trial *p, const double stress[2], double reference,
                           usub_penalty_output *output) {
  double n[2];
  const double size = scaled_stress(p, stress, n);
  usub_penalty_answers(p, output);
  if (!(size > 0.0)) {
    return;
  }
  n[0] /= size;
  n[1] /= size;
  for (int32_t i = 0; i < p->input->directions; ++i) {
    output->tau[i] = p->a[i] * n[i] * p->strength;
  }
  if (p->want_tangent) {
    tangent(p, n, reference, output);
  }
}

int32_t usub_lagrange_update(const usub_penalty_input *input, int32_t stuck, const double *stress,
                             usub_friction_fn friction, void *context, int32_t want_tangent,
                             usub_penalty_output *output) {
  usub_penalty_input rigid = *input;
  rigid.critical_elastic_slip = rigid.stick_slope = 0.0;
  usub_trial p;
  int32_t status = usub_trial_start(&p, &rigid, friction, context, want_tangent);
  if (status != USUB_OK) {
    return status;
  }
  const double l[2] = {stress[0], input->directions == 2 ? stress[1] : 0.0};
  if (!isfinite(l[0]) || !isfinite(l[1])) {
    return USUB_BAD_INPUT;
  }
  const int32_t moves = p.g[0] != 0.0 || p.g[1] != 0.0;
  const double work = p.g[0] * l[0] + p.g[1] * l[1];
  if (!stuck && moves && work >= 0.0) {
    return usub_rigid_slip_update(&rigid, friction, context, want_tangent, output);
  }
  status = usub_trial_ask(&p, 0.0);
  if (status != USUB_OK) {
    return status;
  }
  if (!isfinite(p.strength)) {
    return USUB_NOT_FINITE;
  }
  double scaled[2];
  const double size = scaled_stress(&p, l, scaled);
  const int32_t sticks =
      stuck ? size <= p.strength && !is_beyond_holding(&p, l) : moves || size == 0.0;
  if (sticks && p.strength > 0.0) {
    usub_penalty_answers(&p, output);
    output->sticks = 1;
    output->tau[0] = l[0];
    output->tau[1] = l[1];
    return USUB_OK;
  }
  if (moves && !(p.strength > 0.0)) {
    return usub_rigid_slip_update(&rigid, friction, context, want_tangent, output);
  }
  hold_direction(&p, l, input->critical_elastic_slip, output);
  return USUB_OK;
}
