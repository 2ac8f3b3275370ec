/* SPDX-License-Identifier: MIT */
/* Wanheim-Bay friction, from a coefficient at low pressure to a share of the shear yield stress at
 * high pressure; props: friction factor, shear yield stress. */
#define USUB_LAW "wanheim_bay"
#define USUB_LAW_PROPS 2
#define USUB_LAW_READS_PRESSURE
#include <usersub/coefficient_law.h>
#include <usersub/law_functions.h>

/* With q = sqrt(1 - f), A = 1 + pi/2 + acos f + sqrt((1 - f)(1 + f)), mu0 = f/A and x = p/p1, where
 * p1 = k A/(1 + q): mu = mu0 up to x = 1, mu0 (1 + q (1 - exp((1 - x)/q)))/x beyond. In pairs,
 * since the errors of so many operations add up. */
USUB_LAW_FUNCTION {
  const usub_pair one = {1, 0}, quarter_turn = {1.5707963267948966, 6.123233995736766e-17};
  const usub_pair f = {props[0], 0}, p = {pressure, 0}, k = {props[1], 0};
  const usub_pair turn = {acos(f.high), 0}, free = usub_sum(1, -f.high), q = usub_pair_sqrt(free);
  const usub_pair root = usub_pair_sqrt(usub_pair_times(free, usub_sum(1, f.high)));
  const usub_pair angle =
      usub_pair_add(usub_pair_add(one, root), usub_pair_add(quarter_turn, turn));
  const usub_pair mu0 = usub_pair_over(f, angle);
  const usub_pair x =
      usub_pair_over(usub_pair_times(p, usub_pair_add(one, q)), usub_pair_times(k, angle));
  const usub_pair beyond = usub_pair_less(x, one);
  if (!(beyond.high > 0))
    return (usub_real)(mu0.high + mu0.low);
  const double faded = expm1(-beyond.high / q.high);
  const usub_pair grown = usub_pair_less(one, usub_product(q.high, faded));
  const usub_pair mu = usub_pair_over(usub_pair_times(mu0, grown), x);
  if (derivative)
    derivative[1] = (usub_real)((mu0.high * (1 + faded) - mu.high) / pressure);
  return (usub_real)(mu.high + mu.low);
}
