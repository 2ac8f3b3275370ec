/* SPDX-License-Identifier: MIT */
/* Rate and state friction, slip law, logarithmic; props: mu0, a, b, V0, Dc, theta0, Vmin. */
#define USUB_LAW "rate_state_slip"
#define USUB_LAW_PROPS 7
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

USUB_LAW_FUNCTION {
  const usub_real mu0 = props[0], a = props[1], b = props[2], v0 = props[3], dc = props[4];
  const usub_real start = state[0] > 0 ? state[0] : props[5], x = rate * time_increment / dc;
  const usub_real least = props[6] > USUB_TINY ? props[6] : USUB_TINY;
  const int creeps = rate < least;
  const usub_real v = creeps ? least : rate;
  /* from the steady state, in the logarithm */
  const usub_real distance = usub_log_scaled(v, start, dc);
  /* at large slip theta is counted from its steady state */
  const usub_real found =
      x < (usub_real)0.7 ? start * exp(distance * expm1(-x)) : dc / v * exp(distance * exp(-x));
  const usub_real theta = found > USUB_TINY ? found : USUB_TINY; /* 0 was never set */
  state[0] = theta;
  const usub_real mu = mu0 + a * usub_log_scaled(1, v, v0) + b * usub_log_scaled(v0, theta, dc);
  if (mu < 0)
    return 0;
  if (derivative) {
    usub_real slope, by_rate = -distance * exp(-x);
    if (!creeps)
      by_rate -= usub_mean_decay(x, &slope);
    by_rate = x > USUB_STEADY ? (creeps ? 0 : -1 / v) : by_rate * (time_increment / dc);
    derivative[0] = (creeps ? 0 : a / v) + b * by_rate;
  }
  return mu;
}
