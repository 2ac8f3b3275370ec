/* SPDX-License-Identifier: MIT */
/* Coulomb friction whose elastic slip has a given stiffness; props: coefficient, slope of shear
 * stress over elastic slip. vectors: elastic slip. */
#define USUB_LAW "softened"
#define USUB_LAW_PROPS 2
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#include <usersub/bristle_law.h>
#include <usersub/law_functions.h>

USUB_BRISTLE_FUNCTION {
  const usub_real slope = props[1], full = props[0] * pressure;
  /* An elastic slip below the smallest normal number has no digits: it carries nothing. */
  const usub_real strength = full > slope * USUB_TINY ? full : 0;
  const usub_real trial[2] = {vectors[0][0] + motion[0], vectors[0][1] + motion[1]};
  const usub_real length = hypot(trial[0], trial[1]);
  if (slope * length < strength) {
    for (int i = 0; i < 2; ++i) {
      vectors[0][i] = trial[i];
      traction[i] = slope * trial[i];
      if (tangent)
        tangent[i][i] = slope;
    }
    return;
  }
  /* Left at its limit by a slip, it is above by rounding: at rest its tangent is that of stick. */
  const int sticks = strength > 0 && slope * length <= strength * USUB_ROUNDED;
  const usub_real reach = length > 0 ? length : 1; /* no length: no strength either */
  const usub_real direction[2] = {trial[0] / reach, trial[1] / reach};
  for (int i = 0; i < 2; ++i) {
    traction[i] = strength * direction[i];
    vectors[0][i] = traction[i] / slope;
    for (int j = 0; tangent && j < 2; ++j)
      tangent[i][j] =
          sticks ? slope * (i == j) : strength / reach * ((i == j) - direction[i] * direction[j]);
    if (tangent && !sticks)
      tangent[i][2] = props[0] * direction[i];
  }
}
