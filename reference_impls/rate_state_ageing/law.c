/* SPDX-License-Identifier: MIT */
/* Rate and state friction, ageing law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin. */
#define USUB_LAW "rate_state_ageing"
#define USUB_LAW_PROPS 7
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real mu0 = props[0], a = props[1], b = props[2], v0 = props[3], dc = props[4];
  usub_real theta_by_rate;
  const usub_real theta =
      usub_aged(state[0] > 0 ? state[0] : props[5], rate, time_increment, dc, &theta_by_rate);
  state[0] = theta;
  const int creeps = rate < props[6];
  const usub_real v = creeps ? props[6] : rate;
  const usub_real mu = mu0 + a * usub_log_scaled(1, v, v0) + b * usub_log_scaled(v0, theta, dc);
  if (mu < 0)
    return 0;
  if (derivative)
    derivative[0] = (creeps ? 0 : a / v) + b * (theta_by_rate / theta);
  return mu;
}
