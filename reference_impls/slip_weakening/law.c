/* SPDX-License-Identifier: MIT */
/* Coefficient that falls linearly with the accumulated slip; props: static, dynamic, distance. */
#define USUB_LAW "slip_weakening"
#define USUB_LAW_PROPS 3
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_SLIP
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  const usub_real left = (props[2] - state[0]) - slip, drop = props[0] - props[1];
  state[0] += slip;
  if (!(left > 0))
    return props[1]; /* at the corner the derivative is that of further slip: none */
  if (derivative)
    derivative[3] = -drop / props[2];
  return props[1] + drop * (left / props[2]);
}
