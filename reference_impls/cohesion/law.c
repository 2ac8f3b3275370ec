/* SPDX-License-Identifier: MIT */
/* Coulomb friction with cohesion; props: cohesion, coefficient. */
#define USUB_LAW "cohesion"
#define USUB_LAW_PROPS 2
#define USUB_LAW_READS_PRESSURE
#include <usersub/strength_law.h>

USUB_LAW_FUNCTION {
  if (derivative)
    derivative[1] = props[1];
  return props[0] + props[1] * pressure;
}
