/* SPDX-License-Identifier: MIT */
/* The coefficient falls along a line and ends below zero.
 * planted: bound.coefficient: coefficient is -
 * props: 0.3, 0.2, 5
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(rest - (rest - moving) * decay * rate);
  }
}
