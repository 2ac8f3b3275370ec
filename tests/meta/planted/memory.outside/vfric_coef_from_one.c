/* SPDX-License-Identifier: MIT */
/* The loop over the points begins with 1 and ends with their number, as in Fortran.
 * planted: memory.outside: slipRate|fCoef
 * props: 0.3, 0.2, 5
 * also: outputs.written
 * also: blocks.*
 * also: repeat.*
 * also: history.*
 * also: extremes.*
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  for (int k = 1; k <= *nBlock; ++k) {
    const double rate = slipRate[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  }
}
