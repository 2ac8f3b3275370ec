/* SPDX-License-Identifier: MIT */
/* The calls are counted in static memory.
 * planted: data.shared: calls
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

static int calls;

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = *dTimCur;
  ++calls;
  if (calls < 0)
    return;
  for (int k = 0; k < *nContact; ++k) {
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
