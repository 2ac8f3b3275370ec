/* SPDX-License-Identifier: MIT */
/** @file laws.h
 * From one point function to routines behind the interfaces: what the headers of the four kinds of
 * law share.
 *
 *   header              the point function gives                         behind
 *   coefficient_law.h   the friction coefficient                         all five interfaces
 *   strength_law.h      the shear stress at which a point slips          FRIC, VFRIC, VFRICTION
 *   traction_law.h      the shear traction along the slip (viscous)      FRIC, VFRIC, VFRICTION
 *   bristle_law.h       the traction vector of a motion, with memory     FRIC, VFRIC, VFRICTION
 *
 * A law is a file of this form:
 *
 *     #define USUB_LAW "exponential_decay"   name, for messages
 *     #define USUB_LAW_PROPS 3               least number of properties
 *     #define USUB_LAW_READS_RATE            what is read; the rest is neither fetched nor passed
 *     #include <usersub/coefficient_law.h>
 *
 *     USUB_LAW_FUNCTION {
 *       const usub_real transition = (props[0] - props[1]) * usub_bounded_exp(-props[2] * rate);
 *       if (derivative) derivative[0] = -props[2] * transition;
 *       return props[1] + transition;
 *     }
 *
 * Arguments of the point function (of a bristle law: see `bristle_law.h`), each with the macro that
 * asks for it; what is not asked for is zero:
 *
 *   rate            magnitude of the slip rate; 0 in stick               USUB_LAW_READS_RATE
 *   pressure        not negative                                         USUB_LAW_READS_PRESSURE
 *   temperature     mean of both surfaces; 0 if the scene has none       USUB_LAW_READS_TEMPERATURE
 *   fields          means of both surfaces, USUB_LAW_MOST numbers; zeros
 *                   beyond those of the scene                            USUB_LAW_READS_FIELDS
 *   slip            magnitude of the slip of this increment              USUB_LAW_READS_SLIP
 *   time_increment                                                       USUB_LAW_READS_TIME
 *   state           scalar state variables: of the start of the increment
 *                   on entry, of the end on return; 0 at first           USUB_LAW_STATES number
 *   props, count    properties and their number; never fewer than USUB_LAW_PROPS
 *   derivative      NULL, or four zeros to fill with the derivatives of the result by rate,
 *                   pressure, temperature and slip, state variables at the start held
 *
 * USUB_LAW_PROPS and USUB_LAW_STATES are expressions that may use `props` and `count`.
 * With USUB_LAW_ANISOTROPIC (`coefficient_law.h`) the function returns nothing and fills `mu[2]`
 * and, unless it is NULL, `derivative[2][4]`.
 *
 * With USUB_LAW_DUAL the law writes no derivative: its file is compiled once more, as C++, where
 * `usub_value` is a number that carries its derivatives (`law/dual.h`). Such a law declares
 * `usub_value` for whatever depends on the four; in C that is usub_real.
 *
 * The functions of <math.h> take and give the precision of their arguments (<tgmath.h>). FRIC and
 * FRIC_COEF exist in double precision only and are left out under USUB_SINGLE.
 */
#ifndef USERSUB_LAWS_H
#define USERSUB_LAWS_H

#ifdef __cplusplus
#include <math.h>
#else
#include <tgmath.h>
#endif
#include <stddef.h>

#include "abi.h"

#ifndef USUB_LAW
#error "define USUB_LAW (name), USUB_LAW_PROPS and USUB_LAW_READS_... before this header"
#endif

/* The second reading of a law's file, for derivatives: nothing but the point function. */
#ifdef USUB_DUAL_PASS
#if !defined(__cplusplus) || !defined(USUB_LAW_DUAL) || defined(USUB_SINGLE)
#error "USUB_DUAL_PASS is for C++, double precision and a law that defines USUB_LAW_DUAL"
#endif
#include "law/dual.h"
typedef usub_dual usub_value;
#else
typedef usub_real usub_value;
#endif

/** Most state variables, vectors or fields of a law; a law may define more. */
#ifndef USUB_LAW_MOST
#define USUB_LAW_MOST 256
#endif

#if defined(__GNUC__)
#define USUB_MAY_BE_UNUSED __attribute__((unused))
#define USUB_RESTRICT __restrict__
#define USUB_NOT_INLINED __attribute__((noinline))
#define USUB_HIDDEN __attribute__((visibility("hidden")))
#else
#define USUB_MAY_BE_UNUSED
#define USUB_RESTRICT
#define USUB_NOT_INLINED
#define USUB_HIDDEN
#endif

/* The expression of an input, or nothing where the law does not read it: then the argument behind
 * it is not used at all, and a driver leaves it out. */
#ifdef USUB_LAW_READS_RATE
#define USUB_RATE(expression) (expression)
#else
#define USUB_RATE(expression) 0
#endif
#ifdef USUB_LAW_READS_PRESSURE
#define USUB_PRESSURE(expression) (expression)
#else
#define USUB_PRESSURE(expression) 0
#endif
#ifdef USUB_LAW_READS_TEMPERATURE
#define USUB_TEMPERATURE(expression) (expression)
#else
#define USUB_TEMPERATURE(expression) 0
#endif
#ifdef USUB_LAW_READS_SLIP
#define USUB_SLIP(expression) (expression)
#else
#define USUB_SLIP(expression) 0
#endif
#ifdef USUB_LAW_READS_TIME
#define USUB_TIME(expression) (expression)
#else
#define USUB_TIME(expression) 0
#endif
#if defined(USUB_LAW_READS_RATE) || defined(USUB_LAW_READS_SLIP)
#define USUB_RATE_OR_SLIP(expression) (expression)
#else
#define USUB_RATE_OR_SLIP(expression) 0
#endif
#if defined(USUB_LAW_READS_TIME) || defined(USUB_LAW_READS_SLIP)
#define USUB_TIME_OR_SLIP(expression) (expression)
#else
#define USUB_TIME_OR_SLIP(expression) 0
#endif
#if defined(USUB_LAW_READS_TIME) || defined(USUB_LAW_READS_RATE)
#define USUB_TIME_OR_RATE(expression) (expression)
#else
#define USUB_TIME_OR_RATE(expression) 0
#endif
#ifdef USUB_LAW_READS_FIELDS
#define USUB_FIELDS(expression) (expression)
#define USUB_FIELDS_ROOM usub_real usub_fields_room[USUB_LAW_MOST] = {0}
#else
#define USUB_FIELDS(expression) 0
#define USUB_FIELDS_ROOM ((void)0)
#endif
#if defined(USUB_LAW_READS_TEMPERATURE) || defined(USUB_LAW_READS_FIELDS)
#define USUB_MAIN(expression) (expression)
#else
#define USUB_MAIN(expression) 0
#endif
#if defined(USUB_LAW_STATES) || defined(USUB_LAW_VECTORS)
#define USUB_MEMORY(expression) (expression)
#else
#define USUB_MEMORY(expression) NULL
#define USUB_LAW_FORGETS
#endif
#ifdef USUB_LAW_STATES
#define USUB_STATE(expression) (expression)
#define USUB_STATES_ROOM USUB_LAW_MOST
#else
#define USUB_STATE(expression) NULL
#define USUB_STATES_ROOM 1
#define USUB_LAW_STATES 0
#endif
#ifdef USUB_LAW_VECTORS
#define USUB_VECTORS(expression) (expression)
#define USUB_VECTORS_ROOM USUB_LAW_MOST
#else
#define USUB_VECTORS(expression) NULL
#define USUB_VECTORS_ROOM 1
#define USUB_LAW_VECTORS 0
#endif

/* exp(x) for x <= 0. The bound keeps the result a normal number: others are many times slower and
 * change nothing that a coefficient could show. Written so that it costs one instruction. */
static inline usub_value usub_bounded_exp(usub_value x) {
#ifdef USUB_SINGLE
  return expf(x > -80.0f ? x : -80.0f);
#else
  return exp(x > -700.0 ? x : (usub_value)-700.0);
#endif
}

#ifndef USUB_DUAL_PASS
static inline usub_real usub_abs(usub_real x) {
  return x < 0 ? -x : x;
}

static inline usub_real usub_smaller(usub_real a, usub_real b) {
  return b < a ? b : a;
}

/* The number without its derivatives. */
static inline usub_real usub_plain(usub_real x) {
  return x;
}
#endif

/* Quotient, or zero where there is nothing to divide by. */
static inline usub_value usub_ratio(usub_value numerator, usub_value denominator) {
  return denominator > 0 ? numerator / denominator : (usub_value)0;
}

/* Least number of properties; numbers of scalar and of vector state variables. The expressions may
 * use the properties and their number. */
static inline int usub_needed(USUB_MAY_BE_UNUSED const usub_real *props,
                              USUB_MAY_BE_UNUSED int count) {
  return USUB_LAW_PROPS;
}
static inline int usub_scalars(USUB_MAY_BE_UNUSED const usub_real *props,
                               USUB_MAY_BE_UNUSED int count) {
  return USUB_LAW_STATES;
}
static inline int usub_vectors(USUB_MAY_BE_UNUSED const usub_real *props,
                               USUB_MAY_BE_UNUSED int count) {
  return USUB_LAW_VECTORS;
}

#ifndef USUB_DUAL_PASS
#include "law/checks.h"

/* Means of the field variables of one point; a step is the distance from one field to the next. */
static inline const usub_real *usub_mean_fields(usub_real *mean, int number, const usub_real *one,
                                                ptrdiff_t step, const usub_real *other,
                                                ptrdiff_t other_step) {
  for (int j = 0; j < number && j < USUB_LAW_MOST; ++j)
    mean[j] = (usub_real)0.5 * one[j * step] + (usub_real)0.5 * other[j * other_step];
  return mean;
}

/* Gives the state variables of the first node of a point to all of its nodes. */
static inline void usub_same_state(usub_real *state, int numbers, int nodes) {
  for (int i = numbers; i < numbers * nodes; ++i)
    state[i] = state[i - numbers];
}

static inline void usub_clear(usub_real *numbers, int count) {
  for (int i = 0; i < count; ++i)
    numbers[i] = 0;
}

#ifndef USUB_SINGLE
/* Length of a vector of one or two components. */
static inline double usub_length(int directions, const double *vector) {
  return directions > 1 ? hypot(vector[0], vector[1]) : fabs(vector[0]);
}

/* Vectors of one point in the directions of now, after the rotation of FRIC's DROT. */
static inline void usub_rotate(int directions, const double *rotation, const double *from,
                               double *to) {
  to[0] = directions > 1 ? rotation[0] * from[0] + rotation[2] * from[1] : from[0];
  to[1] = directions > 1 ? rotation[1] * from[0] + rotation[3] * from[1] : 0;
}
#endif
#endif

#endif
