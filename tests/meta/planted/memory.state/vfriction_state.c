/* SPDX-License-Identifier: MIT */
/* The state is used without a look at the number of its variables.
 * planted: memory.state: state
 * props: 0.3, 0.2, 0.01
 * states: 1
 * also: blocks.*
 * also: repeat.*
 * also: history.*
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double first = props[0], last = props[1], length = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    usub_real *slipped = state + *nStates * *nNodState * k;
    for (int i = 0; i < *nNodState; ++i) { /* four times the same behind edges */
      slipped[*nStates * i] += dSlipFric[*nDir * k];
      slipped[*nStates * i + 1] = fNormal[k];
    }
    const double mu = last + (first - last) * exp(-*slipped / length);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
