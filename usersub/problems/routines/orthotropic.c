/* SPDX-License-Identifier: MIT */
/* Friction along the slip, direction by direction with its own coefficient; props: both
 * coefficients, allowable elastic slip. vectors: elastic slip. */
#define USUB_LAW "orthotropic"
#define USUB_LAW_PROPS 3
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#include <usersub/bristle_law.h>

USUB_BRISTLE_FUNCTION {
  const usub_real trial[2] = {vectors[0][0] + motion[0], vectors[0][1] + motion[1]};
  const usub_real length = hypot(trial[0], trial[1]);
  const int slips = length >= props[2];
  const usub_real reach = slips ? length : props[2];
  const usub_real direction[2] = {trial[0] / reach, trial[1] / reach};
  for (int i = 0; i < 2; ++i) {
    const usub_real strength = props[i] * pressure;
    vectors[0][i] = slips ? props[2] * direction[i] : trial[i];
    traction[i] = strength * direction[i];
    if (!tangent)
      continue;
    for (int j = 0; j < 2; ++j)
      tangent[i][j] = strength / reach * ((i == j) - (slips ? direction[i] * direction[j] : 0));
    tangent[i][2] = props[i] * direction[i];
  }
}
