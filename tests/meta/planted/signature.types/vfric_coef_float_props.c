/* SPDX-License-Identifier: MIT */
/* The properties are declared float.
 * planted: signature.types: props.*float
 * props: 0.3, 0.2, 5
 * precision: double
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfric_coef, VFRIC_COEF)(
    usub_real *fCoef, usub_real *fCoefDeriv, const int *nBlock, const int *nProps,
    const int *nTemp, const int *nFields, const int *jFlags, const usub_real *rData,
    const char *surfInt, const char *surfSec, const char *surfMain, const float *props,
    const usub_real *slipRate, const usub_real *pressure, const usub_real *tempAvg,
    const usub_real *fieldAvg) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = (usub_real)(props[1] + (props[0] - props[1]) * exp(-props[2] * slipRate[k]));
}
