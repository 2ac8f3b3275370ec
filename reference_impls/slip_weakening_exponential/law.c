/* SPDX-License-Identifier: MIT */
/* Coefficient that decays with the accumulated slip; props: static, dynamic, distance. */
#define USUB_LAW "slip_weakening_exponential"
#define USUB_LAW_PROPS 3
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_SLIP
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  state[0] += slip;
  const usub_real left = (props[0] - props[1]) * usub_bounded_exp(-state[0] / props[2]);
  if (derivative)
    derivative[3] = -left / props[2];
  return props[1] + left;
}
