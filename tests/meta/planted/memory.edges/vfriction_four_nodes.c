/* SPDX-License-Identifier: MIT */
/* The main surface is taken to have facets of four nodes; an edge has two.
 * planted: memory.edges: shapeMain|coordMain
 * props: 0.3, 0.2, 0.01
 * states: 2
 * also: blocks.permute
 * also: blocks.split
 * also: repeat.same
 * also: repeat.order
 * also: repeat.threads
 * also: history.save-load
 * also: blocks.*
 * also: repeat.*
 * also: history.*
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double first = props[0], last = props[1], length = props[2];
  if (*nStates < 1)
    return;
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    usub_real *slipped = state + *nStates * *nNodState * k;
    for (int i = 0; i < *nNodState; ++i) /* four times the same behind edges */
      slipped[*nStates * i] += dSlipFric[*nDir * k];
    if (*nStates > 1 && *nNodMain > 1) {
      slipped[1] = 0; /* height of the main surface */
      for (int i = 0; i < 4; ++i)
        slipped[1] += shapeMain[4 * k + i] * coordMain[*nDir * (4 * k + i) + 2];
    }
    const double mu = last + (first - last) * exp(-*slipped / length);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
