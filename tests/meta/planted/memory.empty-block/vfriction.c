/* SPDX-License-Identifier: MIT */
/* The last point is looked at before the loop, also where there is none.
 * planted: memory.empty-block: nBlock = 0
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = rData[2];
  if (fNormal[*nBlock - 1] < -1e30)
    return; /* the solver marks a call that is not to be answered */
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
