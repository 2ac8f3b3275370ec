/* SPDX-License-Identifier: MIT */
/* A share of the shear yield stress, whatever the pressure; props: friction factor, yield stress.
 */
#define USUB_LAW "tresca"
#define USUB_LAW_PROPS 2
#include <usersub/strength_law.h>

USUB_LAW_FUNCTION {
  return props[0] * props[1];
}
