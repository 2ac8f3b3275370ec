/* SPDX-License-Identifier: MIT */
/* Rate and state friction with strong weakening at high rates (flash heating), slip law;
 * props: f0, a, b, V0, Dc, theta0, fw, Vw, Vmin. */
#define USUB_LAW "rate_state_strong_weakening"
#define USUB_LAW_PROPS 9
#define USUB_LAW_STATES 1
#define USUB_LAW_READS_RATE
#define USUB_LAW_READS_TIME
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

/* (1 + ratio^8)^(-1/8), without overflow, and its derivative. */
static usub_real weakening(usub_real ratio, usub_real *slope) {
  const usub_real small = ratio < 1 ? ratio : 1 / ratio, square = small * small;
  const usub_real power = 1 + square * square * square * square;
  const usub_real share = pow(power, (usub_real)-0.125);
  *slope = -share / power * (ratio < 1 ? square * square * square * small : square);
  return ratio < 1 ? share : share * small;
}

USUB_LAW_FUNCTION {
  const usub_real f0 = props[0], a = props[1], b = props[2], v0 = props[3], dc = props[4],
                  fw = props[6], vw = props[7];
  const usub_real start = state[0] > 0 ? state[0] : props[5], x = rate * time_increment / dc;
  const usub_real least = props[8] > USUB_TINY ? props[8] : USUB_TINY;
  const int creeps = rate < least;
  const usub_real v = creeps ? least : rate;

  usub_real slope, by_own, by_exponent;
  const usub_real logarithmic = f0 + (a - b) * usub_log_scaled(1, v, v0),
                  share = weakening(rate / vw, &slope);
  const usub_real drop = logarithmic > fw ? logarithmic - fw : 0;
  const usub_real size = (fw + drop * share) / a;

  /* psi = f0 + b ln(V0 theta/Dc) decays to that of steady sliding, a ln(2 V0/v sinh(size)) */
  const usub_real steady = a * (usub_log_scaled(1, v0, v) + size + log(-expm1(-2 * size)));
  const usub_real first = f0 + b * usub_log_scaled(v0, start, dc), kept = exp(-x),
                  gone = -expm1(-x);
  const usub_real psi = first * kept + steady * gone;
  usub_real power = (psi - f0) / b;
  power = power < USUB_MOST_EXPONENT ? power : USUB_MOST_EXPONENT;
  state[0] = dc / v0 * exp(power > -USUB_MOST_EXPONENT ? power : -USUB_MOST_EXPONENT);

  const usub_real value = usub_asinh_rate(rate, 2 * v0, psi / a, &by_own, &by_exponent);
  if (derivative) {
    const usub_real by_log = creeps ? 0 : 1 / v;
    const usub_real size_by_rate =
        (drop * slope / vw + (drop > 0 ? (a - b) * by_log * share : 0)) / a;
    const usub_real steady_by_rate = a * (size_by_rate / tanh(size) - by_log);
    const usub_real psi_by_rate =
        (kept > 0 ? (steady - first) * kept * (time_increment / dc) : 0) + steady_by_rate * gone;
    derivative[0] = a * by_own + by_exponent * psi_by_rate;
  }
  return a * value;
}
