/* SPDX-License-Identifier: MIT */
/* Rate and state friction, ageing law, its state integrated over the increment by the theta rule;
 * props: mu0, a, b, V0, Dc, theta0, Vmin, weight (0 explicit Euler, 1/2 trapezoidal rule, 1
 * implicit Euler). */
#define USUB_LAW "ageing_theta"
#define USUB_LAW_PROPS 8
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real mu0 = props[0], a = props[1], b = props[2], v0 = props[3], dc = props[4];
  const usub_real weight = props[7], share = rate * time_increment / dc;
  const usub_real before = state[0] > 0 ? state[0] : props[5];
  const usub_real under = 1 + weight * share;
  const usub_real theta = (before * (1 - (1 - weight) * share) + time_increment) / under;
  state[0] = theta;
  const int creeps = rate < props[6];
  const usub_real v = creeps ? props[6] : rate;
  const usub_real mu = mu0 + a * usub_log_scaled(1, v, v0) + b * usub_log_scaled(v0, theta, dc);
  if (mu < 0)
    return 0;
  if (derivative)
    derivative[0] = (creeps ? 0 : a / v) - b * (time_increment / dc) *
                                               ((1 - weight) * before + weight * theta) /
                                               (under * theta);
  return mu;
}
