/* SPDX-License-Identifier: MIT */
/* Creep without a yield point: slip rate = k traction; props: k. */
#define USUB_LAW "viscoplastic_creep"
#define USUB_LAW_PROPS 1
#define USUB_LAW_READS_RATE
#include <usersub/traction_law.h>

USUB_LAW_FUNCTION {
  if (derivative)
    derivative[0] = 1 / props[0];
  return rate / props[0];
}
