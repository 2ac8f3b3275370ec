/* SPDX-License-Identifier: MIT */
/* The coefficient is kept in an integer and is zero.
 * planted: friction.present: is 0 in all
 * props: 0.3, 0.2, 5
 * also: precision.digits
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (int)(moving + (rest - moving) * exp(-decay * rate));
  }
}
