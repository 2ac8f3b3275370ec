/* SPDX-License-Identifier: MIT */
/* The pressure is the normal force over an area that can be zero.
 * planted: zero.area: (?i)nan|not a number|finite
 * props: 0.3, 0.2, 5
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = *dTimCur;
  for (int k = 0; k < *nContact; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    const double p = fNormal[k] / areaSec[jConSecid[k] - 1]; /* less friction under high pressure */
    double force = mu * (1 + p) / (1 + 2 * p) * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
