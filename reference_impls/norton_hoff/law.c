/* SPDX-License-Identifier: MIT */
/* Norton-Hoff friction, a power of the slip rate; props: consistency, exponent, rate below which
 * the traction becomes linear. */
#define USUB_LAW "norton_hoff"
#define USUB_LAW_PROPS 3
#define USUB_LAW_READS_RATE
#include <usersub/traction_law.h>

#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real n = props[1], length = hypot(rate, props[2]);
  if (!(length > 0)) {
    if (derivative && n == 1)
      derivative[0] = props[0];
    return 0;
  }
  const usub_real share = rate / length;
  const usub_real power = usub_product_of_powers(props[0], 1, &length, &n);
  if (derivative)
    derivative[0] = power / length * (1 + (n - 1) * share * share);
  return power * share;
}
