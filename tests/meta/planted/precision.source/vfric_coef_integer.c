/* SPDX-License-Identifier: MIT */
/* A property is kept in an integer, which keeps its value only by luck.
 * planted: precision.source: (?i)conver|integer|int|trunc
 * props: 0.3, 0.2, 5
 * precision: double
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1];
  const int power = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-power * rate));
  }
}
