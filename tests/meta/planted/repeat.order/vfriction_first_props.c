/* SPDX-License-Identifier: MIT */
/* The properties of the first call are kept for all interactions.
 * planted: repeat.order: order|before|other|props
 * props: 0.3, 0.2, 5
 * also: repeat.same
 * also: repeat.threads
 * also: history.cut-back
 * also: history.iterations
 * also: history.save-load
 * also: blocks.permute
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  static double rest, moving, decay;
  if (rest == 0) {
    rest = props[0];
    moving = props[1];
    decay = props[2];
  }
  const double dt = rData[2];
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
