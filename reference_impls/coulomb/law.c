/* SPDX-License-Identifier: MIT */
/* Coulomb friction: a constant coefficient, props(1). */
#define USUB_LAW "coulomb"
#define USUB_LAW_PROPS 1
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  return props[0];
}
