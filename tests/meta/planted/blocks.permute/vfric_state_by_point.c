/* SPDX-License-Identifier: MIT */
/* The state is looked up by contact point, not by node.
 * planted: blocks.permute: order|permut|place|position
 * props: 0.3, 0.2, 0.01
 * states: 1
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  const double first = props[0], last = props[1], length = props[2];
  if (*nStateVar < 1)
    return;
  for (int k = 0; k < *nContact; ++k) {
    if (fNormal[k] <= 0)
      continue;
    usub_real *slipped = statev + *nStateVar * k;
    *slipped += dSlipFric[*nDir * k];
    const double mu = last + (first - last) * exp(-*slipped / length);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
