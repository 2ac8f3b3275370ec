/* SPDX-License-Identifier: MIT */
/* The field variables are taken for those of consecutive points, which is right for one only.
 * planted: blocks.permute: with 3 field variables
 * props: 0.3, 0.1
 * fields: 1
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double field = *nFields > 0 ? fabs(fieldSec[k]) : 0;
    const double force = (props[0] + props[1] * field) * fNormal[k];
    fTangential[*nFricDir * k] = (usub_real) - (force > fStickForce[k] ? fStickForce[k] : force);
  }
}
