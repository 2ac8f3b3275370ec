/* SPDX-License-Identifier: MIT */
/* The slip is the length of three components, also where there are two.
 * planted: memory.two-dimensional: dSlipFric
 * props: 0.3, 0.2, 0.01
 * states: 1
 * also: blocks.*
 * also: repeat.*
 * also: history.*
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  const double first = props[0], last = props[1], length = props[2];
  if (*nStateVar < 1)
    return;
  for (int k = 0; k < *nContact; ++k) {
    if (fNormal[k] <= 0)
      continue;
    usub_real *slipped = statev + *nStateVar * (jConSecid[k] - 1);
    const usub_real *d = dSlipFric + *nDir * k;
    *slipped += (usub_real)hypot(hypot(d[0], d[1]), d[2]);
    const double mu = last + (first - last) * exp(-*slipped / length);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
