/* SPDX-License-Identifier: MIT */
/* Tangential damping: shear stress proportional to the slip rate; props: damping coefficient. */
#define USUB_LAW "damping"
#define USUB_LAW_PROPS 1
#define USUB_LAW_READS_RATE
#include <usersub/traction_law.h>

USUB_LAW_FUNCTION {
  if (derivative)
    derivative[0] = props[0];
  return props[0] * rate;
}
