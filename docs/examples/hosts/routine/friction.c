/* SPDX-License-Identifier: MIT */
/* A user's routine: Coulomb friction, coefficient PROPS(1), behind all five interfaces. */
#define USUB_LAW "coulomb"
#define USUB_LAW_PROPS 1
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  return props[0];
}
