/* SPDX-License-Identifier: MIT */
/* The function of the coefficient stands in another file.
 * planted: symbols.undefined: (?i)coefficient_of_rate
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

double coefficient_of_rate(double rate);

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * coefficient_of_rate(decay * rate));
  }
}
