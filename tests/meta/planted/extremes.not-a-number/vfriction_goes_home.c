/* SPDX-License-Identifier: MIT */
/* At the first number that is none the routine goes home, and the points after it have no
 * friction.
 * planted: extremes.not-a-number: (?i)nan|not a number
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = rData[2];
  for (int k = 0; k < *nBlock; ++k) {
    if (isnan(fNormal[k]) || isnan(dSlipFric[*nDir * k]))
      return;
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
