/* SPDX-License-Identifier: MIT */
/* The temperature of the main surface is read for every point; an analytical rigid surface has
 * one.
 * planted: memory.analytical-rigid: temp
 * props: 0.3, 0.2, 5
 * also: blocks.*
 * also: repeat.*
 * also: history.*
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = rData[2];
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double mean = *nTemp > 0 ? 0.5 * (tempSec[k] + tempMain[k]) : 0;
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    double force = mu * exp(-0.002 * mean) * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
