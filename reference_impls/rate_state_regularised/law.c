/* SPDX-License-Identifier: MIT */
/* Rate and state friction, ageing law, regularised at rest; props: f0, a, b, V0, Dc, theta0. */
#define USUB_LAW "rate_state_regularised"
#define USUB_LAW_PROPS 6
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real f0 = props[0], a = props[1], b = props[2], v0 = props[3], dc = props[4];
  usub_real theta_by_rate, by_rate, by_exponent;
  const usub_real theta =
      usub_aged(state[0] > 0 ? state[0] : props[5], rate, time_increment, dc, &theta_by_rate);
  state[0] = theta;
  const usub_real exponent = (f0 + b * usub_log_scaled(v0, theta, dc)) / a;
  const usub_real value = usub_asinh_rate(rate, 2 * v0, exponent, &by_rate, &by_exponent);
  if (derivative)
    derivative[0] = a * by_rate + b * by_exponent * (theta_by_rate / theta);
  return a * value;
}
