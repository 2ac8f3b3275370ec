/* SPDX-License-Identifier: MIT */
/* The stick force is not looked at.
 * planted: bound.stick-force: (?i)fStickForce|stick force
 * props: 0.3, 0.2, 5
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
    const double force = mu * fNormal[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
