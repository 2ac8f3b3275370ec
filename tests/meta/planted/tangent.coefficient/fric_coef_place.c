/* SPDX-License-Identifier: MIT */
/* The derivative by the slip rate stands in the place of that by the pressure.
 * planted: tangent.coefficient: fCoefDeriv
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  const int n = *nBlock;
  for (int k = 0; k < n; ++k) {
    const double rate = slipData[k], change = (rest - moving) * exp(-decay * rate);
    fCoef[k] = moving + change;
    fCoefDeriv[k + n] = -decay * change; /* by rate, pressure, temperature */
    fCoefDeriv[k] = fCoefDeriv[k + 2 * n] = 0;
  }
}
