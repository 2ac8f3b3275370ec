/* SPDX-License-Identifier: MIT */
/** @file law/explicit.h
 * VFRIC and VFRICTION of a coefficient, strength or traction (part of their headers).
 *
 * The first component of the force is -min(friction force, stick force), the friction force being
 * coefficient * normal force, or stress * area. Points without normal force have none, and keep
 * their state. State variables: those of the law, in VFRIC by surface node; in VFRICTION all nodes
 * of a point (edges have several) get the same.
 */
#ifndef USERSUB_LAW_EXPLICIT_H
#define USERSUB_LAW_EXPLICIT_H

#include "point.h"

#include "begin.h"

#ifdef USUB_LAW_GIVES_STRESS
#define USUB_FORCE(law, normal_force, area) ((law) * (area))
#else
#define USUB_FORCE(law, normal_force, area) ((law) * (normal_force))
#endif

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  USUB_FIELDS_ROOM;
  if (!USUB_EXPLICIT_PROPS("VFRIC", props, *nProps) ||
      !USUB_STATES_NEEDED(EXPLICIT, USUB_STATES_TEXT("VFRIC"), props, *nProps,
                          usub_scalars(props, *nProps), *nStateVar))
    return;
  for (int i = 0; i < *nContact; ++i) {
    if (!(fNormal[i] > 0))
      continue;
    USUB_MAY_BE_UNUSED const int other = USUB_MAIN(i < *numDefTfv ? i : *numDefTfv - 1);
    const usub_real law = usub_law(
        USUB_RATE(usub_ratio(usub_abs(dSlipFric[(ptrdiff_t)i * *nDir]), *dTimCur)),
        USUB_PRESSURE(usub_ratio(fNormal[i], areaSec[jConSecid[i] - 1])),
        USUB_TEMPERATURE(*nTemp > 0 ? (usub_real)0.5 * (tempSec[i] + tempMain[other])
                                    : (usub_real)0),
        USUB_FIELDS(usub_mean_fields(usub_fields_room, *nPred, preDefSec + i, *nContact,
                                     preDefMain + other, *numDefTfv)),
        USUB_SLIP(usub_abs(dSlipFric[(ptrdiff_t)i * *nDir])), USUB_TIME(*dTimCur),
        USUB_STATE(statev + (ptrdiff_t)*nStateVar * (jConSecid[i] - 1)), props, *nProps, NULL);
    fTangential[(ptrdiff_t)i * *nFricDir] =
        -usub_smaller(USUB_FORCE(law, fNormal[i], areaSec[jConSecid[i] - 1]), fStickForce[i]);
  }
}

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  USUB_FIELDS_ROOM;
  if (!USUB_EXPLICIT_PROPS("VFRICTION", props, *nProps) ||
      !USUB_STATES_NEEDED(EXPLICIT, USUB_STATES_TEXT("VFRICTION"), props, *nProps,
                          usub_scalars(props, *nProps), *nStates))
    return;
  for (int k = 0; k < *nBlock; ++k) {
    if (!(fNormal[k] > 0))
      continue;
    USUB_MAY_BE_UNUSED const int other = USUB_MAIN(k < *nBlockAnal ? k : *nBlockAnal - 1);
    const usub_real law = usub_law(
        USUB_RATE(usub_ratio(usub_abs(dSlipFric[(ptrdiff_t)k * *nDir]), rData[2])),
        USUB_PRESSURE(usub_ratio(fNormal[k], areaCont[k])),
        USUB_TEMPERATURE(*nTemp > 0 ? (usub_real)0.5 * (tempSec[k] + tempMain[other])
                                    : (usub_real)0),
        USUB_FIELDS(usub_mean_fields(usub_fields_room, *nFields, fieldSec + (ptrdiff_t)k * *nFields,
                                     1, fieldMain + (ptrdiff_t)other * *nFields, 1)),
        USUB_SLIP(usub_abs(dSlipFric[(ptrdiff_t)k * *nDir])), USUB_TIME(rData[2]),
        USUB_STATE(state + (ptrdiff_t)*nStates * *nNodState * k), props, *nProps, NULL);
#ifndef USUB_LAW_FORGETS
    usub_same_state(state + (ptrdiff_t)*nStates * *nNodState * k, *nStates, *nNodState);
#endif
    fTangential[(ptrdiff_t)k * *nFricDir] =
        -usub_smaller(USUB_FORCE(law, fNormal[k], areaCont[k]), fStickForce[k]);
  }
}

#include "end.h"

#endif
