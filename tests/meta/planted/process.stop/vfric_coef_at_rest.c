/* SPDX-License-Identifier: MIT */
/* A point at rest ends the whole analysis.
 * planted: process.stop: (?i)stop|exit|raise
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(xplb_exit, XPLB_EXIT)(void);

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    if (rate == 0)
      FOR_NAME(xplb_exit, XPLB_EXIT)();
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  }
}
