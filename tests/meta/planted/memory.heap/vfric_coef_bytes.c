/* SPDX-License-Identifier: MIT */
/* Room is asked for in bytes and used in reals.
 * planted: memory.heap: its own memory|it allocated
 * props: 0.3, 0.2, 5
 * also: memory.outside
 * also: blocks.*
 * also: repeat.*
 * also: history.*
 * also: extremes.*
 * also: process.crash
 */
#include <math.h>
#include <stdlib.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2];
  double *volatile rates = malloc((size_t)*nBlock + 1);
  for (int k = 0; k < *nBlock; ++k)
    rates[k] = slipRate[k];
  for (int k = 0; k < *nBlock; ++k) {
    const double rate = rates[k];
    fCoef[k] = (usub_real)(moving + (rest - moving) * exp(-decay * rate));
  }
  free(rates);
}
