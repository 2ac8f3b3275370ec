/* SPDX-License-Identifier: MIT */
/* No slip: all motion is elastic slip of a given stiffness, whatever the pressure; props: slope of
 * shear stress over elastic slip. vectors: elastic slip. */
#define USUB_LAW "softened_rough"
#define USUB_LAW_PROPS 1
#define USUB_LAW_VECTORS 1
#include <usersub/bristle_law.h>

USUB_BRISTLE_FUNCTION {
  for (int i = 0; i < 2; ++i) {
    vectors[0][i] += motion[i];
    traction[i] = props[0] * vectors[0][i];
    if (tangent)
      tangent[i][i] = props[0];
  }
}
