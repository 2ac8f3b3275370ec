/* SPDX-License-Identifier: MIT */
/* The coefficients at rest and at high rate are exchanged.
 * planted: limits.rate: (?i)rest|rate|limit
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[1], moving = props[0], decay = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  }
}
