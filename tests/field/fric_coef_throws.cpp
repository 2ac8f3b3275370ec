// SPDX-License-Identifier: MIT
// C++: a static counter, and an exception where the pressure is out of range.
#include <omi_for_c.h>

#include <stdexcept>
#include <string>

static int calls;

extern "C" void FOR_NAME(fric_coef, FRIC_COEF)(
    double *fCoef, double *fCoefDeriv, const int *nBlock, const int *, const int *, const int *,
    const int *iData, double *rData, const char *surfInt, const char *, const char *,
    const double *props, const double *slipData, const double *pressure, const double *,
    const double *, std::size_t lengthInt, std::size_t, std::size_t) {
  ++calls;
  const std::string name(surfInt, lengthInt);
  for (int k = 0; k < *nBlock; ++k) {
    if (pressure[k] > props[1]) throw std::range_error("pressure above the range, 100% wrong");
    fCoef[k] = props[0] * (name.compare(0, 4, "WET ") == 0 ? 0.5 : 1.0) + 0.0 * slipData[k];
  }
  fCoefDeriv[*nBlock] = rData[2] * iData[0];
}
