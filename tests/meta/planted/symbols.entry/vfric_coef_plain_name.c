/* SPDX-License-Identifier: MIT */
/* The entry has no underscore: FOR_NAME is missing.
 * planted: symbols.entry: vfric_coef
 * props: 0.3, 0.2, 5
 */
#include <math.h>
#include <usersub/abi.h>

void vfric_coef(USUB_VFRIC_COEF_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fCoef[k] = (usub_real)(props[1] + (props[0] - props[1]) * exp(-props[2] * slipRate[k]));
}
