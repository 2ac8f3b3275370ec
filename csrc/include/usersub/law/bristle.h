/* SPDX-License-Identifier: MIT */
/** @file law/bristle.h
 * FRIC, VFRIC and VFRICTION of a bristle law (part of `bristle_law.h`).
 */
#ifndef USERSUB_BRISTLE_ROUTINES_H
#define USERSUB_BRISTLE_ROUTINES_H

#include "begin.h"

#define USUB_STATE_NUMBERS(directions, props, count)                                               \
  ((directions)*usub_vectors(props, count) + usub_scalars(props, count))

/* Second local direction of three, n x t1. */
static inline void usub_second(usub_real *t2, const usub_real *t1, const usub_real *n) {
  t2[0] = n[1] * t1[2] - n[2] * t1[1];
  t2[1] = n[2] * t1[0] - n[0] * t1[2];
  t2[2] = n[0] * t1[1] - n[1] * t1[0];
}

/* Vectors of an explicit point in its local directions, and back; with two directions (nDir) there
 * is no second one, and the second component is zero. */
static inline void usub_to_local(usub_real (*local)[2], int vectors, const usub_real *global,
                                 int directions, const usub_real *t1, const usub_real *t2) {
  for (int i = 0; i < vectors; ++i) {
    local[i][0] = local[i][1] = 0;
    for (int d = 0; d < directions; ++d) {
      local[i][0] += global[i * directions + d] * t1[d];
      local[i][1] += directions > 2 ? global[i * directions + d] * t2[d] : 0;
    }
  }
}

static inline void usub_to_global(usub_real (*local)[2], int vectors, usub_real *global,
                                  int directions, const usub_real *t1, const usub_real *t2) {
  for (int i = 0; i < vectors; ++i)
    for (int d = 0; d < directions; ++d)
      global[i * directions + d] = local[i][0] * t1[d] + (directions > 2 ? local[i][1] * t2[d] : 0);
}

/* Force of one explicit point; `memory` has its vectors and scalars, or is NULL. */
static inline void usub_bristle_force(usub_real *force, const usub_real *slip, int directions,
                                      usub_real area, usub_real time_increment, usub_real pressure,
                                      usub_real temperature, const usub_real *fields,
                                      USUB_MAY_BE_UNUSED usub_real *memory,
                                      USUB_MAY_BE_UNUSED const usub_real *t1,
                                      USUB_MAY_BE_UNUSED const usub_real *n, const usub_real *props,
                                      int count) {
  const usub_real motion[2] = {slip[0], directions > 2 ? slip[1] : 0};
  const int vectors = usub_vectors(props, count);
  usub_real traction[2] = {0, 0}, t2[3] = {0, 0, 0}, room[USUB_VECTORS_ROOM][2];
  if (vectors > 0 && directions > 2)
    usub_second(t2, t1, n);
  usub_to_local(room, vectors, memory, directions, t1, t2);
  usub_bristle(motion, time_increment, pressure, temperature, fields, room,
               USUB_STATE(memory + (ptrdiff_t)directions * vectors), props, count, traction, NULL);
  usub_to_global(room, vectors, memory, directions, t1, t2);
  for (int d = 0; d < directions - 1; ++d)
    force[d] = -traction[d] * area;
}

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  USUB_FIELDS_ROOM;
  if (!USUB_EXPLICIT_PROPS("VFRIC", props, *nProps) ||
      !USUB_STATES_NEEDED(EXPLICIT, USUB_STATES_TEXT("VFRIC"), props, *nProps,
                          USUB_STATE_NUMBERS(*nDir, props, *nProps), *nStateVar))
    return;
  for (int i = 0; i < *nContact; ++i) {
    const ptrdiff_t first = (ptrdiff_t)i * *nDir;
    USUB_MAY_BE_UNUSED const int other = USUB_MAIN(i < *numDefTfv ? i : *numDefTfv - 1);
    usub_real *memory = USUB_MEMORY(statev + (ptrdiff_t)*nStateVar * (jConSecid[i] - 1));
    if (!(fNormal[i] > 0))
      continue;
    const usub_real area = areaSec[jConSecid[i] - 1];
    usub_bristle_force(fTangential + (ptrdiff_t)i * *nFricDir, dSlipFric + first, *nDir, area,
                       USUB_TIME(*dTimCur), USUB_PRESSURE(usub_ratio(fNormal[i], area)),
                       USUB_TEMPERATURE(*nTemp > 0 ? (usub_real)0.5 * (tempSec[i] + tempMain[other])
                                                   : (usub_real)0),
                       USUB_FIELDS(usub_mean_fields(usub_fields_room, *nPred, preDefSec + i,
                                                    *nContact, preDefMain + other, *numDefTfv)),
                       memory, USUB_VECTORS(dirCosSl + first), USUB_VECTORS(dircosN + first), props,
                       *nProps);
  }
}

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  USUB_FIELDS_ROOM;
  if (!USUB_EXPLICIT_PROPS("VFRICTION", props, *nProps) ||
      !USUB_STATES_NEEDED(EXPLICIT, USUB_STATES_TEXT("VFRICTION"), props, *nProps,
                          USUB_STATE_NUMBERS(*nDir, props, *nProps), *nStates))
    return;
  for (int k = 0; k < *nBlock; ++k) {
    const ptrdiff_t first = (ptrdiff_t)k * *nDir;
    USUB_MAY_BE_UNUSED const int other = USUB_MAIN(k < *nBlockAnal ? k : *nBlockAnal - 1);
    usub_real *memory = USUB_MEMORY(state + (ptrdiff_t)*nStates * *nNodState * k);
    if (!(fNormal[k] > 0))
      continue;
    usub_bristle_force(
        fTangential + (ptrdiff_t)k * *nFricDir, dSlipFric + first, *nDir, areaCont[k],
        USUB_TIME(rData[2]), USUB_PRESSURE(usub_ratio(fNormal[k], areaCont[k])),
        USUB_TEMPERATURE(*nTemp > 0 ? (usub_real)0.5 * (tempSec[k] + tempMain[other])
                                    : (usub_real)0),
        USUB_FIELDS(usub_mean_fields(usub_fields_room, *nFields, fieldSec + (ptrdiff_t)k * *nFields,
                                     1, fieldMain + (ptrdiff_t)other * *nFields, 1)),
        memory, USUB_VECTORS(dircosSl + first), USUB_VECTORS(dircosN + first), props, *nProps);
#ifndef USUB_LAW_FORGETS
    usub_same_state(memory, *nStates, *nNodState);
#endif
  }
}

#ifndef USUB_SINGLE
/* A motion below has no direction that can be divided by: the point is at rest. */
#define USUB_LEAST_MOTION 1e-280
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  USUB_FIELDS_ROOM;
  if (*LM == 2) { /* open so far: no friction in the increment that closes the point */
#ifndef USUB_LAW_FORGETS
    usub_clear(STATEV, *NSTATV);
#endif
    return;
  }
  if (!USUB_STANDARD_PROPS("FRIC", PROPS, *NPROPS) ||
      !USUB_STATES_NEEDED(STANDARD, USUB_STATES_TEXT("FRIC"), PROPS, *NPROPS,
                          USUB_STATE_NUMBERS(n, PROPS, *NPROPS), *NSTATV) ||
      !USUB_TIME_NEEDED(*DTIME))
    return;
  *LM = 0;

  const int vectors = usub_vectors(PROPS, *NPROPS);
  const double size = fabs(DGAM[0]) + (n > 1 ? fabs(DGAM[1]) : 0);
  const int moves = size > USUB_LEAST_MOTION;
  const double motion[2] = {moves ? DGAM[0] : 0, moves && n > 1 ? DGAM[1] : 0};
  double traction[2] = {0, 0}, tangent[2][4] = {{0}}, room[USUB_VECTORS_ROOM][2];
  for (int i = 0; i < vectors; ++i)
    usub_rotate(n, USUB_VECTORS(DROT), USUB_VECTORS(STATEV + (ptrdiff_t)i * n), room[i]);
  usub_ask(motion, USUB_TIME(*DTIME), USUB_PRESSURE(*PRESS > 0 ? *PRESS : 0),
           USUB_TEMPERATURE(0.5 * (TEMP[0] + TEMP[1])),
           USUB_FIELDS(usub_mean_fields(usub_fields_room, *NPRED, PREDEF, 2, PREDEF + 1, 2)), room,
           USUB_STATE(STATEV + (ptrdiff_t)n * vectors), PROPS, *NPROPS, traction, tangent);
  *SED = *SFD = 0;
  for (int a = 0; a < n; ++a) {
    TAU[a] = traction[a];
    DSLIP[a] = DGAM[a];
    DDTDDP[a] = USUB_PRESSURE(*PRESS >= 0 ? tangent[a][2] : 0);
    DDTDDT[a] = DDTDDT[a + n] = 0.5 * tangent[a][3];
    for (int b = 0; b < n; ++b)
      DDTDDG[a + n * b] = tangent[a][b];
    *SFD += TAU[a] * DSLIP[a];
#ifndef USUB_LAW_FORGETS
    for (int i = 0; i < vectors; ++i)
      STATEV[n * i + a] = room[i][a];
#endif
  }
}
#endif

#include "end.h"

#endif
