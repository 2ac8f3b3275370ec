/* SPDX-License-Identifier: MIT */
/* Exponential decay between coefficients that are linear in temperature and pressure;
 * props: Cs, Ds, Ck, Dk, decay. */
#define USUB_LAW "temperature_pressure_decay"
#define USUB_LAW_PROPS 5
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TEMPERATURE
#include <usersub/coefficient_law.h>

USUB_LAW_FUNCTION {
  const usub_real at_rest = props[0] * temperature + props[1] * pressure;
  const usub_real sliding = props[2] * temperature + props[3] * pressure;
  const usub_real share = usub_bounded_exp(-props[4] * rate);
  const usub_real mu = sliding + (at_rest - sliding) * share;
  if (mu < 0)
    return 0;
  if (derivative) {
    derivative[0] = -props[4] * (at_rest - sliding) * share;
    derivative[1] = props[3] + (props[1] - props[3]) * share;
    derivative[2] = props[2] + (props[0] - props[2]) * share;
  }
  return mu;
}
