/* SPDX-License-Identifier: MIT */
/* The shape functions of the secondary side are read for nodes too; only edges have them.
 * planted: memory.outside: shapeSec
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
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    const double share = shapeSec[*nNodSec * k] < -2 ? 0 : 1;
    double force = mu * share * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
