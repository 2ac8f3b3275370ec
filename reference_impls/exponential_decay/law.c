/* SPDX-License-Identifier: MIT */
/* Exponential decay from a static to a kinetic coefficient; props: static, kinetic, decay. */
#define USUB_LAW "exponential_decay"
#define USUB_LAW_PROPS 3
#define USUB_LAW_READS_RATE
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  const usub_real fall = props[0] - props[1];
  const usub_real transition = fall * usub_bounded_exp(-props[2] * rate);
  if (derivative)
    derivative[0] = -props[2] * transition;
  if (fall < 0) /* the same from the other end, where nothing cancels */
    return props[0] + fall * expm1(-props[2] * rate);
  return props[1] + transition;
}
