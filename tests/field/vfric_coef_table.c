/* SPDX-License-Identifier: MIT */
/* Falls with the slip rate down to a floor; keeps no data. */
#include <math.h>
#include <omi_for_c.h>
#include <usersub/usersub.h>

static usub_real at(usub_real rate, const usub_real *props) {
  return props[1] + (props[0] - props[1]) * (usub_real)exp((double)(-props[2] * rate));
}

void FOR_NAME(vfric_coef, VFRIC_COEF)(usub_real *fCoef, usub_real *fCoefDeriv, const int *nBlock,
                                      const int *nProps, const int *nTemp, const int *nFields,
                                      const int *jFlags, const usub_real *rData,
                                      const char *surfInt, const char *surfSec,
                                      const char *surfMain, const usub_real *props,
                                      const usub_real *slipRate, const usub_real *pressure,
                                      const usub_real *tempAvg, const usub_real *fieldAvg) {
  for (int k = 0; k < *nBlock; ++k) fCoef[k] = at(slipRate[k], props);
}
