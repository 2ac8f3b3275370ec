/* SPDX-License-Identifier: MIT */
/* What FRIC and the enforcement of FRIC_COEF share. */
#ifndef USERSUB_STANDARD_H
#define USERSUB_STANDARD_H

#include <string.h>

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
  double *committed_coefficient, *start_coefficient, *committed_allowable, *start_allowable;
} usub_point_arrays;

usub_point_arrays usub_point_arrays_of(const usub_driver *driver);
/** DSLIP and the tangents of a point that has none of its own: open, or constrained by the host. */
void usub_clear_slip_and_tangent(const usub_point_arrays *at, int32_t directions, int32_t p);

static inline int usub_is_fric(const usub_driver *driver) {
  return usub_interface_key(driver->face) == USUB_INTERFACE_FRIC;
}

/* fric_plan.c, fric.c */
void usub_fric_plan(usub_driver *driver);
/** The closed point `p`. */
int32_t usub_fric_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                        int32_t index, int32_t p);
/** What the routine is told and the host has in another form, for the points of `call`. */
void usub_fric_fill(usub_driver *driver, const usub_call *call, const usub_point_arrays *at,
                    int32_t first);
/** Takes what the routine answered for the closed ones of `count` points from `first`, where the
 * call began. */
int32_t usub_fric_take(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                       int32_t index, int32_t first, int32_t count);
/** Says why a call for points from `first` ended, after what was answered before is taken. */
int32_t usub_fric_ended(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                        int32_t index, int32_t first, int32_t status, const char *reason);
/** A point that the host constrains (1) or leaves alone (2): nothing else of the answer counts. */
int32_t usub_fric_constrain(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                            int32_t index, int32_t p);

/** Numbers of the points that are wanted (1), zero for the others (0). Without branches: which
 * points are wanted cannot be foreseen. */
static inline void usub_choose(size_t n, double *restrict to, const double *restrict from,
                               const unsigned char *restrict wanted) {
  for (size_t k = 0; k < n; ++k) {
    uint64_t bits;
    memcpy(&bits, from + k, sizeof bits);
    bits &= -(uint64_t)wanted[k];
    memcpy(to + k, &bits, sizeof bits);
  }
}

/** In words: a routine said so itself. */
static inline const char *usub_failure(int32_t status) {
  return status == USUB_ROUTINE_RAISED ? "an exception" : "its status";
}

/* fric_together.c */
/** Points `first` to `first + n - 1`, open and closed.
 * @return status; USUB_ONE_BY_ONE, with nothing done, if there is something to refuse. */
int32_t usub_fric_together(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t first, int32_t n);
enum { USUB_ONE_BY_ONE = 1000 };
/** Whether the host has the point in contact. */
static inline int usub_is_closed(const usub_point_arrays *at, int32_t p) {
  return at->closed ? at->closed[p] != 0 : at->pressure[p] > 0;
}

/* fric_coef_point.c */
void usub_fric_coef_plan(usub_driver *driver);
int32_t usub_fric_coef_point(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                             int32_t index, int32_t p);
void usub_fric_coef_open_point(usub_driver *driver, const usub_point_arrays *at, int32_t p);

/* changing.c */
/** The two coefficients that the point starts the step with. */
const double *usub_start_coefficient(const usub_driver *driver, const usub_point_arrays *at,
                                     int32_t p);
/** Allowable elastic slip of the point in this increment; 0 where the scene has none. */
double usub_allowable_elastic_slip(const usub_driver *driver, const usub_point_arrays *at,
                                   int32_t p);
/** Commits what later steps start from. */
void usub_commit_changing(usub_driver *driver, const usub_point_arrays *at);

/** LM on entry: that of the last iteration, or the condition of the last increment. */
static inline int32_t usub_lm_on_entry(const usub_driver *driver, const usub_point_arrays *at,
                                       int32_t p) {
  const usub_iteration *last = &driver->last;
  return last->done && last->closed[p] ? last->lm[p] : at->condition[p];
}

/** Refuses NaN and infinity in what a point returns; `how` they came about is for the message. */
int32_t usub_check_answers(usub_driver *driver, usub_call *call, const usub_point_arrays *at,
                           int32_t index, int32_t p, const char *how);
/** Refuses NaN and infinity in the state variables that the routine left for point `p`. */
int32_t usub_check_trial_state(usub_driver *driver, usub_call *call, int32_t index, int32_t p);

#endif
