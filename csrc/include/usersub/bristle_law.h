/* SPDX-License-Identifier: MIT */
/** @file bristle_law.h
 * A law that gives the traction vector from the motion of the increment and remembers: bristles,
 * springs, dashpots; behind FRIC, VFRIC and VFRICTION. See `laws.h` for the form of a law's file;
 * here the point function is
 *
 *     #define USUB_LAW_VECTORS 1             number of vector state variables
 *     #include <usersub/bristle_law.h>
 *
 *     USUB_BRISTLE_FUNCTION {
 *       for (int a = 0; a < 2; ++a) {
 *         vectors[0][a] += motion[a];
 *         traction[a] = props[0] * vectors[0][a];
 *         if (tangent) tangent[a][a] = props[0];
 *       }
 *     }
 *
 *   motion          two components of the sliding motion of the increment, the second zero with one
 *                   friction direction
 *   time_increment, pressure, temperature, fields    as in `laws.h`, with USUB_LAW_READS_TIME, ...
 *   vectors         vector state variables, `vectors[i][0]` and `vectors[i][1]` in the directions
 *                   of now, and
 *   state           scalar ones: of the start of the increment on entry, of the end on return
 *   props, count    as in `laws.h`
 *   traction        the result, positive along the motion; zeros on entry
 *   tangent         NULL, or `tangent[2][4]`, zeros to fill with the derivatives of both
 *                   tractions by motion 1, motion 2, pressure, temperature
 *
 * USUB_LAW_VECTORS and USUB_LAW_STATES are expressions in `props` and `count`. With USUB_LAW_DUAL
 * the law writes no tangent.
 *
 * State variables behind FRIC: the vectors, NFDIR numbers each, one after the other, then the
 * scalars. Behind VFRIC and VFRICTION, where the local directions change from call to call: the
 * vectors in global components, nDir numbers each, then the scalars; what a turn of the surface
 * leaves along the normal is dropped.
 *
 * Forces: -traction * area in both directions, not bounded by the stick force, since a bristle
 * brings its own stick and pushes back. Points without normal force have none, and keep their
 * state; in the increment that closes a point behind FRIC (LM = 2 on entry) there is no friction,
 * and all of its state is zero then. Behind FRIC, DSLIP is the motion and SFD the work of the
 * increment: what the law stores and what it dissipates is not told apart.
 */
#ifndef USERSUB_BRISTLE_LAW_H
#define USERSUB_BRISTLE_LAW_H

#include "laws.h"

/* Arguments in the type `number` of what carries derivatives. */
#define USUB_BRISTLE_ARGUMENTS(number)                                                             \
  USUB_MAY_BE_UNUSED const number *motion, USUB_MAY_BE_UNUSED const usub_real time_increment,      \
      USUB_MAY_BE_UNUSED const number pressure, USUB_MAY_BE_UNUSED const number temperature,       \
      USUB_MAY_BE_UNUSED const usub_real *fields, USUB_MAY_BE_UNUSED number(*vectors)[2],          \
      USUB_MAY_BE_UNUSED number *state, USUB_MAY_BE_UNUSED const usub_real *props,                 \
      USUB_MAY_BE_UNUSED const int count, USUB_MAY_BE_UNUSED number *traction,                     \
      USUB_MAY_BE_UNUSED usub_real(*tangent)[4]

/* Opens the definition of the point function; below, its declaration. */
#define USUB_BRISTLE_FUNCTION static inline void usub_bristle(USUB_BRISTLE_ARGUMENTS(usub_value))
USUB_BRISTLE_FUNCTION;

#if defined(USUB_LAW_DUAL) && !defined(USUB_SINGLE)
#ifdef __cplusplus
extern "C" {
#endif
/* The point function with derivatives, from the second reading of the file. */
USUB_HIDDEN void usub_law_dual(USUB_BRISTLE_ARGUMENTS(usub_real));
#ifdef __cplusplus
}
#endif
#endif

#ifdef USUB_DUAL_PASS
/* State variables enter as values: they belong to the start of the increment. */
void usub_law_dual(USUB_BRISTLE_ARGUMENTS(usub_real)) {
  usub_dual vector_room[USUB_LAW_MOST][2], state_room[USUB_LAW_MOST];
  const int numbers = 2 * usub_vectors(props, count), states = usub_scalars(props, count);
  for (int i = 0; i < numbers; ++i)
    vector_room[i / 2][i % 2] = vectors[i / 2][i % 2];
  for (int i = 0; i < states; ++i)
    state_room[i] = state[i];
  const usub_dual moves[2] = {usub_dual::variable(motion[0], 0), usub_dual::variable(motion[1], 1)};
  usub_dual result[2] = {0.0, 0.0};
  usub_bristle(moves, time_increment, usub_dual::variable(pressure, 2),
               usub_dual::variable(temperature, 3), fields, vector_room, state_room, props, count,
               result, NULL);
  for (int i = 0; i < numbers; ++i)
    vectors[i / 2][i % 2] = vector_room[i / 2][i % 2].v;
  for (int i = 0; i < states; ++i)
    state[i] = state_room[i].v;
  for (int a = 0; a < 2; ++a) {
    traction[a] = result[a].v;
    for (int j = 0; j < 4 && tangent; ++j)
      tangent[a][j] = result[a].d[j];
  }
}
#else
#ifndef USUB_SINGLE
static inline void usub_ask(USUB_BRISTLE_ARGUMENTS(double)) {
#ifdef USUB_LAW_DUAL
  usub_law_dual(motion, time_increment, pressure, temperature, fields, vectors, state, props, count,
                traction, tangent);
#else
  usub_bristle(motion, time_increment, pressure, temperature, fields, vectors, state, props, count,
               traction, tangent);
#endif
}
#endif
#include "law/bristle.h"
#endif

#endif
