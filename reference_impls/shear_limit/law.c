/* SPDX-License-Identifier: MIT */
/* Coulomb friction up to a largest shear stress; props: coefficient, largest shear stress. */
#define USUB_LAW "shear_limit"
#define USUB_LAW_PROPS 2
#define USUB_LAW_READS_PRESSURE
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  if (!(pressure > 0))
    return props[0];
  const usub_real limited = props[1] / pressure;
  if (props[0] < limited)
    return props[0];
  if (derivative)
    derivative[1] = -limited / pressure;
  return limited;
}
