/* SPDX-License-Identifier: MIT */
/* The temperature of the first call is kept as the reference for all points.
 * planted: repeat.order: order|before|other
 * props: 0.3, 0.2, 5
 * also: repeat.same
 * also: repeat.threads
 * also: history.cut-back
 * also: history.iterations
 * also: history.save-load
 * also: blocks.permute
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  const int n = *nBlock;
  static int known;
  static double reference;
  if (!known && n > 0 && *nTemp > 0) {
    reference = tempAvg[0];
    known = 1;
  }
  for (int k = 0; k < n; ++k) {
    const double rate = slipData[k], change = (rest - moving) * exp(-decay * rate);
    const double warm = exp(-0.002 * ((*nTemp > 0 ? tempAvg[k] : reference) - reference));
    fCoef[k] = warm * (moving + change);
    fCoefDeriv[k] = -decay * change * warm; /* by rate, pressure, temperature */
    fCoefDeriv[k + n] = 0;
    fCoefDeriv[k + 2 * n] = -0.002 * fCoef[k];
  }
}
