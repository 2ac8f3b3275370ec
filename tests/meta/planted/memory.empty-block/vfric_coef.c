/* SPDX-License-Identifier: MIT */
/* The loop runs once before it looks at the number of points.
 * planted: memory.empty-block: nBlock = 0
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  int k = 0;
  do {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  } while (++k < *nBlock);
}
