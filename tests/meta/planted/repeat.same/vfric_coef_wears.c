/* SPDX-License-Identifier: MIT */
/* The routine counts its calls, and the coefficient wears with them.
 * planted: repeat.same: repe|again|second
 * props: 0.3, 0.2, 5
 * also: repeat.order
 * also: repeat.threads
 * also: history.cut-back
 * also: history.iterations
 * also: history.save-load
 * also: blocks.permute
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  static double wear = 1;
  wear *= 0.999;
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + wear * (rest - moving) * exp(-decay * rate));
  }
}
