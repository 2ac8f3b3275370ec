/* SPDX-License-Identifier: MIT */
/* Powers of pressure, slip rate and temperature, each at least its floor; props: factor; exponents
 * of pressure, slip rate, temperature; their floors. */
#define USUB_LAW "power_law"
#define USUB_LAW_PROPS 7
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real *exponents = props + 1, *floors = props + 4;
  const usub_real bases[3] = {fmax(pressure, floors[0]), fmax(rate, floors[1]),
                              fmax(temperature, floors[2])};
  const usub_real mu = usub_product_of_powers(props[0], 3, bases, exponents);
  if (derivative) {
    derivative[0] = rate < floors[1] ? 0 : exponents[1] * mu / bases[1];
    derivative[1] = pressure < floors[0] ? 0 : exponents[0] * mu / bases[0];
    derivative[2] = temperature < floors[2] ? 0 : exponents[2] * mu / bases[2];
  }
  return mu;
}
