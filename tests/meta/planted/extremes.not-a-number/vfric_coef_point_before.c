/* SPDX-License-Identifier: MIT */
/* Where the rate is no number, the point before is answered once more.
 * planted: extremes.not-a-number: (?i)nan|not a number
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  double rate = 0;
  for (int k = 0; k < *nBlock; ++k) {
    if (slipRate[k] == slipRate[k])
      rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  }
}
