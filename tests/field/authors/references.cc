// SPDX-License-Identifier: MIT
// C++: FRIC_COEF of 2022 with references and casts to fixed-size arrays, extern "C" on the function, state behind rData[7]
#include <cmath>
#include <omi_for_c.h>
extern "C" void FOR_NAME(fric_coef, FRIC_COEF)(double *fCoef, double *fCoefDeriv, int &nBlock, int &nProps, int &nTemp,
    int &nFields, int *iData, double *rData, char *surfInt, char *surfSec, char *surfMain, double *props,
    double *slipData, double *pressure, double *tempAvg, double *fieldAvg)
{
  auto &derivative = *reinterpret_cast<double(*)[2][20]>(fCoefDeriv);
  enum { slipRate, slipRate1, slipRate2, slipEq, slip1, slip2 };
  const double decay = std::exp(-props[2] * slipData[slipRate]);
  fCoef[0] = props[1] + (props[0] - props[1]) * decay;
  derivative[0][0] = -props[2] * (props[0] - props[1]) * decay;
  double *state = &rData[7];
  for (int i = 0; i < iData[4]; ++i) state[i] += slipData[slipEq];
}
