/* SPDX-License-Identifier: MIT */
/* The scratch memory of a point is 4 MiB on the stack.
 * planted: memory.stack: (?i)stack
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
  volatile double work[*nBlock + 1][1 << 19];
  work[0][0] = work[*nBlock][0] = 1;
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    work[k][k] = mu;
    double force = work[k][k] * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
