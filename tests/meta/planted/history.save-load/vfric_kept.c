/* SPDX-License-Identifier: MIT */
/* The slip is kept by node inside the routine, where no restart finds it; statev gets a copy.
 * planted: history.save-load: load|restart|save
 * props: 0.3, 0.2, 0.01
 * states: 1
 * also: repeat.order
 * also: repeat.same
 * also: repeat.threads
 * also: history.cut-back
 * also: history.iterations
 * also: blocks.permute
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

static double kept[10000]; /* slip by node */

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  const double first = props[0], last = props[1], length = props[2];
  if (*nStateVar < 1)
    return;
  for (int k = 0; k < *nContact; ++k) {
    if (fNormal[k] <= 0)
      continue;
    usub_real *slipped = statev + *nStateVar * (jConSecid[k] - 1);
    double *slip = kept + (jSecUid[jConSecid[k] - 1] & 0x1fff);
    *slip = timStep[0] <= *dTimCur ? dSlipFric[*nDir * k] : *slip + dSlipFric[*nDir * k];
    *slipped = (usub_real)*slip;
    const double mu = last + (first - last) * exp(-*slipped / length);
    double force = mu * fNormal[k];
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
