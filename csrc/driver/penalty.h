/* SPDX-License-Identifier: MIT */
/** @file penalty.h
 * Penalty (elastic slip) enforcement of a friction coefficient at one contact point, with the
 * consistent tangent: what the standard driver does with the answer of FRIC_COEF.
 *
 * Let g = elastic slip at the start + slip increment, m = (mu1 + mu2)/2, a_i = mu_i / m (both one
 * if isotropic), g~_i = a_i g_i, T = min(m p, shear limit), zero for p < 0, c = critical elastic
 * slip, or T / stick slope where a stick slope is given (softened tangential behaviour):
 *
 *   stick, |g~| <= c:  tau_i = (T/c) a_i^2 g_i                  plastic slip 0
 *   slip,  |g~| >  c:  tau_i = T a_i g~_i / |g~|                plastic slip (1 - c/|g~|) g
 *
 * so that the scaled stress tau_i / a_i is collinear with the scaled slip and bounded by T, and
 * |tau| <= T if isotropic. The coefficients are asked for at the plastic slip of the end of the
 * increment; if they decide on that slip themselves, being two or with a stick slope, that leaves
 * one equation for the plastic fraction 1 - c/|g~| of the predictor. It is bracketed from the
 * start, so it is always solved (at a jump of the coefficient: to the place of the jump); sticking
 * is preferred where both are solutions.
 *
 * A direction whose coefficient is exactly zero while the other's is not is frictionless: all its
 * motion is plastic slip. If both are zero, a_i = 1 and the stress is zero.
 *
 * Energy: with T constant, change of SED + SFD = tau . slip increment - (1/2) d . K d, where d is
 * the change of the elastic slip and K its stiffness: the work of the stress at the end of the
 * increment, less the error of taking it there, which is never negative, vanishes in steady
 * sliding and is of second order in the increment otherwise. If T changes, the stiffness T/c
 * and with it SED change without work. A stick slope is a constant stiffness (with one
 * coefficient), and the statement holds whatever T does. SFD is never negative.
 */
#ifndef USUB_PENALTY_H
#define USUB_PENALTY_H

#include <stdint.h>

/** What FRIC_COEF answered for one point. */
typedef struct usub_friction_value {
  double mu[2]; /* [1] is read only if anisotropic */
  /* By rate magnitude, pressure, temperature, rate 1, rate 2, equivalent slip, slip 1, slip 2. */
  double d_mu[2][8];
} usub_friction_value;

/** Asks for the coefficients.
 * @param slip_data  rate magnitude, rate 1, rate 2, equivalent slip, slip 1, slip 2, all at the end
 *                   of the increment
 * @return 0, or a status that ends the update.
 * An update may ask more than once; its answer belongs to the last call. Every call has to start
 * from the committed state variables.
 */
typedef int32_t (*usub_friction_fn)(void *context, const double slip_data[6],
                                    usub_friction_value *value);

typedef struct usub_penalty_input {
  int32_t directions;  /* 1 or 2: length of the three vectors below */
  int32_t anisotropic; /* two coefficients; no meaning with one direction */
  double pressure;
  double time_increment;        /* >= 0; with 0 (no time passes) slip rates are zero */
  double critical_elastic_slip; /* > 0; not read where there is a stick slope */
  double stick_slope;           /* stress per elastic slip in stick; 0 none */
  double shear_limit;           /* limit of the equivalent (scaled) stress; 0 none */
  const double *elastic_slip;   /* at the start of the increment */
  const double *slip;           /* plastic, accumulated, at the start */
  const double *slip_increment; /* of this increment, elastic and plastic */
  double equivalent_slip;       /* at the start */
} usub_penalty_input;

typedef struct usub_penalty_output {
  double tau[2];
  double elastic_slip[2];           /* at the end */
  double slip_increment_plastic[2]; /* DSLIP */
  double equivalent_slip_increment; /* its length */
  double d_tau_d_gamma[2][2];       /* row stress, column slip increment */
  double d_tau_d_pressure[2];       /* from above at p = 0 */
  double d_tau_d_temperature[2];    /* by the mean temperature */
  double sed;                       /* elastic energy tau . elastic slip / 2 */
  double sfd;                       /* dissipation tau . plastic slip */
  int32_t sticks;                   /* 1 if there is no plastic slip */
  double mu[2];
  double mu_by_pressure[2]; /* as the routine answered; not set without want_tangent */
} usub_penalty_output;

/** Stress, slips, energies and tangent of one point at the end of the increment.
 * @param want_tangent  0 leaves the derivatives zero and those of the coefficients unread
 * @return USUB_OK; the status of `friction`; USUB_BAD_ARGUMENT for a setting out of its range;
 *         USUB_BAD_INPUT for a pressure or slip that is not finite or overflows; USUB_CONTRACT for
 *         a negative coefficient; USUB_NOT_FINITE for a coefficient, derivative or stress that
 *         is not finite. After a failure the output is not defined.
 * Values of branches that meet (sticking at |g~| = c, m p at the shear limit) have the derivative
 * of sticking and of m p. Uses no memory but its own; any thread.
 */
int32_t usub_penalty_update(const usub_penalty_input *input, usub_friction_fn friction,
                            void *context, int32_t want_tangent, usub_penalty_output *output);

#endif
