/* SPDX-License-Identifier: MIT */
/* What FRIC and the penalty enforcement of FRIC_COEF share. */
#ifndef USERSUB_STANDARD_H
#define USERSUB_STANDARD_H

#include "internal.h"

/** PNEWDT on entry: a large number that no routine means. */
#define USUB_PNEWDT_PRESET 1e36

/** Conditions of a point, as LM on entry. */
enum { USUB_SLIPPING = 0, USUB_STICKING = 1, USUB_OPEN = 2 };

/** Memory of the arrays of a standard driver; NULL where there is none. */
typedef struct usub_point_arrays {
  int32_t *lm, *condition;
  const int32_t *closed, *node;
  double *tau, *ddtddg, *ddtddp, *ddtddt, *dslip, *sed, *sfd;
  double *slip, *state, *committed_tau, *committed_sed, *committed_pressure;
  const double *slip_increment, *pressure, *multiplier, *rotation;
  const double *temperature[2], *field[2];
  double *elastic_slip, *equivalent_slip, *coefficient;
} usub_point_arrays;

usub_point_arrays usub_point_arrays_of(const usub_driver *driver);
/** DSLIP and the tangents of a point that has none of its own: open, or constrained by the host. */
void usub_clear_slip_and_tangent(const usub_point_arrays *at, int32_t directions, int32_t p);

static inline int usub_is_fric(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_FRIC;
}

/* fric_plan.c, fric.c */
void usub_fric_plan(usub_driver *driver);
int32_t usub_fric_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                        int32_t index, int32_t p);

/* penalty_driver.c: FRIC_COEF */
void usub_penalty_plan(usub_driver *driver);
int32_t usub_penalty_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p);
void usub_penalty_open_point(usub_driver *driver, const usub_point_arrays *at, int32_t p);

/** Refuses NaN and infinity in what a point returns; `how` they came about is for the message. */
int32_t usub_check_answers(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p, const char *how);
/** Refuses NaN and infinity in the state variables that the routine left for point `p`. */
int32_t usub_check_trial_state(usub_driver *driver, usub_call *call, int32_t index, int32_t p);

#endif
