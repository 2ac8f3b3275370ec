/* SPDX-License-Identifier: MIT */
/* No friction. */
#define USUB_LAW "frictionless"
#define USUB_LAW_PROPS 0
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  return 0;
}
