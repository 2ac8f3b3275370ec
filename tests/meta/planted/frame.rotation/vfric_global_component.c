/* SPDX-License-Identifier: MIT */
/* The slip is summed in its first global component only, so the weakening depends on the axes.
 * planted: frame.rotation: rotat|turn|axes|frame
 * props: 0.3, 0.2, 0.01
 * states: 1
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
    *slipped += dSlipFric[*nDir * k] * (usub_real)fabs((double)dirCosSl[*nDir * k]);
    const double mu = last + (first - last) * exp(-*slipped / length);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
