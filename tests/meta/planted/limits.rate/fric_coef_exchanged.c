/* SPDX-License-Identifier: MIT */
/* The coefficients at rest and at high rate are exchanged.
 * planted: limits.rate: (?i)rest|rate|limit
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const double rest = props[1], moving = props[0], decay = props[2];
  const int n = *nBlock;
  for (int k = 0; k < n; ++k) {
    const double rate = slipData[k], change = (rest - moving) * exp(-decay * rate);
    fCoef[k] = moving + change;
    fCoefDeriv[k] = -decay * change; /* by rate, pressure, temperature */
    fCoefDeriv[k + n] = fCoefDeriv[k + 2 * n] = 0;
  }
}
