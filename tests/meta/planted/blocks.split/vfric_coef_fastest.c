/* SPDX-License-Identifier: MIT */
/* The coefficient is that of the fastest point of the block.
 * planted: blocks.split: block|split|call
 * props: 0.3, 0.2, 5
 * also: extremes.not-a-number
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  double rate = 0;
  for (int k = 0; k < *nBlock; ++k)
    rate = slipRate[k] <= rate ? rate : slipRate[k];
  for (int k = 0; k < *nBlock; ++k) {
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  }
}
