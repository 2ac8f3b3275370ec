/* SPDX-License-Identifier: MIT */
/* Dahl's bristle, integrated over the increment by the theta rule; props: coefficient, stiffness,
 * theta (0 explicit Euler, 1/2 trapezoidal rule, 1 implicit Euler). vectors: bend. */
#define USUB_LAW "dahl_theta"
#define USUB_LAW_PROPS 3
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#include <usersub/bristle_law.h>

USUB_BRISTLE_FUNCTION {
  const usub_real limit = props[0] * pressure / props[1], theta = props[2];
  const usub_real length = hypot(motion[0], motion[1]), share = length / limit;
  for (int a = 0; a < 2; ++a) {
    if (!(limit > 0)) {
      vectors[0][a] = 0;
      continue;
    }
    const usub_real before = vectors[0][a];
    const usub_real after =
        (before + motion[a] - (1 - theta) * share * before) / (1 + theta * share);
    const usub_real mean = ((1 - theta) * before + theta * after) / (1 + theta * share);
    vectors[0][a] = after;
    traction[a] = props[1] * after;
    for (int b = 0; b < 2 && tangent; ++b)
      tangent[a][b] = props[1] * ((a == b) / (1 + theta * share) -
                                  (length > 0 ? mean / limit * (motion[b] / length) : 0));
    if (tangent)
      tangent[a][2] = props[1] * mean * share / pressure;
  }
}
