/* SPDX-License-Identifier: MIT */
/* The coefficient falls along a line and ends below zero.
 * planted: bound.coefficient: coefficient is -
 * props: 0.3, 0.2, 5
 * also: extremes.*
 */
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  const int n = *nBlock;
  for (int k = 0; k < n; ++k) {
    const double rate = slipData[k], change = (rest - moving) * (1 - decay * rate);
    fCoef[k] = moving + change;
    fCoefDeriv[k] = -decay * (rest - moving); /* by rate, pressure, temperature */
    fCoefDeriv[k + n] = fCoefDeriv[k + 2 * n] = 0;
  }
}
