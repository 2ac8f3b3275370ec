/* SPDX-License-Identifier: MIT */
/* The slip of the increment is divided by the step time.
 * planted: limits.rate: step time
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], time = rData[0];
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double slip = dSlipFric[*nDir * k], rate = time > 0 ? slip / time : 0;
    const double force = (moving + (rest - moving) * exp(-decay * rate)) * fNormal[k];
    fTangential[*nFricDir * k] = (usub_real) - (force > fStickForce[k] ? fStickForce[k] : force);
  }
}
