/* SPDX-License-Identifier: MIT */
/** @file trial.h
 * One contact point on its way to a stress: what the coefficients make of a plastic slip. Shared by
 * penalty.c and lagrange.c; the quantities are those of penalty.h.
 */
#ifndef USUB_TRIAL_H
#define USUB_TRIAL_H

#include "penalty.h"

/** Columns of d_mu. */
enum {
  USUB_BY_RATE,
  USUB_BY_PRESSURE,
  USUB_BY_TEMPERATURE,
  USUB_BY_RATE_1,
  USUB_BY_RATE_2,
  USUB_BY_EQUIVALENT,
  USUB_BY_SLIP_1,
  USUB_BY_SLIP_2
};

/** The four things that stresses are differentiated by. */
enum { USUB_GAMMA_1, USUB_GAMMA_2, USUB_PRESSURE_OF, USUB_TEMPERATURE_OF, USUB_VARIABLES };

typedef struct usub_trial {
  const usub_penalty_input *input;
  usub_friction_fn friction;
  void *context;
  int32_t anisotropic; /* and two directions */
  int32_t want_tangent;
  int32_t frictionless[2]; /* direction whose whole motion is plastic */
  double g[2];             /* elastic predictor */
  /* Of the last question: */
  double plastic[2];
  double length; /* of the plastic slip */
  usub_friction_value value;
  double a[2];            /* mu_i over the mean */
  double mean;            /* of the coefficients */
  double scaled;          /* |g~| with these a */
  double strength;        /* T, may be infinite */
  int32_t on_coefficient; /* T is m p, not the shear limit */
} usub_trial;

/** Prepares a trial; an allowable elastic slip of zero is not refused.
 * @return USUB_OK, USUB_BAD_ARGUMENT or USUB_BAD_INPUT, as in penalty.h */
int32_t usub_trial_start(usub_trial *trial, const usub_penalty_input *input,
                         usub_friction_fn friction, void *context, int32_t want_tangent);
/** Asks for the coefficients where `fraction` of the predictor is plastic slip. */
int32_t usub_trial_ask(usub_trial *trial, double fraction);
/** Derivatives of the coefficients (first index) by the plastic slip, whose direction is `unit`. */
void usub_trial_by_slip(const usub_trial *trial, const double unit[2], double by_plastic[2][2]);
/** Derivative of a_1 = 2 - a_2 when the coefficients change by d1 and d2. */
double usub_trial_ratio(const usub_trial *trial, double d1, double d2);
/** Derivative of T when they do, at constant pressure. */
double usub_trial_strength(const usub_trial *trial, double d1, double d2);

/** The part of an output that is the answer of the routine; the rest is zero. */
void usub_penalty_answers(const usub_trial *trial, usub_penalty_output *output);
/** usub_penalty_update that allows an elastic slip of zero: then all motion is plastic slip. */
int32_t usub_rigid_slip_update(const usub_penalty_input *input, usub_friction_fn friction,
                               void *context, int32_t want_tangent, usub_penalty_output *output);

#endif
