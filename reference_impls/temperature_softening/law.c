/* SPDX-License-Identifier: MIT */
/* A coefficient that falls with the temperature; props: form (1 power, 2 exponential), coefficient
 * when cold and when hot, temperatures of both, exponent. */
#define USUB_LAW "temperature_softening"
#define USUB_LAW_PROPS 6
#define USUB_LAW_READS_TEMPERATURE
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real hot = props[2], fall = props[1] - hot;
  usub_real slope;
  const usub_real share =
      props[0] == 1 ? usub_drop_of_power(temperature, props[3], props[4], props[5], &slope)
                    : usub_decay_of_power(temperature, props[3], props[4], props[5], &slope);
  if (derivative)
    derivative[2] = fall * slope;
  return hot + fall * share;
}
