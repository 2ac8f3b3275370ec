/* SPDX-License-Identifier: MIT */
#include <omi_for_c.h>
void FOR_NAME(vfric_coef, VFRIC_COEF)(double *fCoef, double *fCoefDeriv, int nBlock, int *nProps,
                                      int *nTemp, int *nFields, int *jFlags, float *rData,
                                      char *surfInt, char *surfSec, char *surfMain, long *props,
                                      double *slipRate, double *pressure, double *tempAvg,
                                      double *fieldAvg) {
  fCoef[0] = props[0] * rData[0] * nBlock;
}
