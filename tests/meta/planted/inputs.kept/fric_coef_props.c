/* SPDX-License-Identifier: MIT */
/* The properties are scaled in place.
 * planted: inputs.kept: props
 * props: 0.3, 0.2, 5, 70
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  const int n = *nBlock;
  ((double *)props)[3] = 0.001 * props[3]; /* given in thousandths */
  for (int k = 0; k < n; ++k) {
    const double rate = slipRate[k], change = (rest - moving) * exp(-decay * rate);
    fCoef[k] = moving + change;
    fCoefDeriv[k] = -decay * change; /* by rate, pressure, temperature */
    fCoefDeriv[k + n] = fCoefDeriv[k + 2 * n] = 0;
  }
}
