/* SPDX-License-Identifier: MIT */
/* The largest normal force of the block sets the pressure of all.
 * planted: blocks.split: block|split|call
 * props: 0.3, 0.2, 5
 * also: extremes.not-a-number
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = rData[2];
  double largest = 0;
  for (int k = 0; k < *nBlock; ++k)
    largest = fNormal[k] <= largest ? largest : fNormal[k];
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate - 0.001 * largest);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
