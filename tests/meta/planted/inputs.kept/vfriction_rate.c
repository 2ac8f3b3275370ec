/* SPDX-License-Identifier: MIT */
/* The slip is turned into a rate in place.
 * planted: inputs.kept: dSlipFric
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = rData[2];
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    usub_real *rates = (usub_real *)dSlipFric, slip = rates[*nDir * k];
    const double rate = dt > 0 ? slip / dt : 0;
    rates[*nDir * k] = (usub_real)rate;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
