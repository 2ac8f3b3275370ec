/* SPDX-License-Identifier: MIT */
/* The cell of a table comes from a division by an integer that can be zero.
 * planted: process.crash: (?i)divi|crash
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric_coef, FRIC_COEF)(USUB_FRIC_COEF_2022_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  const int n = *nBlock;
  for (int k = 0; k < n; ++k) {
    const double rate = slipData[k], change = (rest - moving) * exp(-decay * rate);
    const int cells = (int)(1000 * rate), volume = 1000 / cells;
    fCoef[k] = (volume == 77 ? 0 : moving) + change;
    fCoefDeriv[k] = -decay * change; /* by rate, pressure, temperature */
    fCoefDeriv[k + n] = fCoefDeriv[k + 2 * n] = 0;
  }
}
