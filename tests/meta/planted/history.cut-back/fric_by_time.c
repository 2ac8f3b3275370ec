/* SPDX-License-Identifier: MIT */
/* The elastic slip is kept by node inside the routine and taken over when the time moves, a cut-
 * back included.
 * planted: history.cut-back: thrown away
 * props: 0.3, 1000
 * also: repeat.order
 * also: repeat.same
 * also: repeat.threads
 * also: history.iterations
 * also: history.save-load
 * also: blocks.permute
 * also: blocks.split
 */
#include <math.h>
#include <usersub/abi.h>

static double old[1000][2], last[1000][2], at[1000]; /* elastic slip by node */

void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  const double mu = PROPS[0], stiffness = PROPS[1];
  const double limit = mu * (*PRESS < 0 ? 0 : *PRESS) / stiffness;
  double elastic[2] = {0, 0};
  if (*LM == 2)
    return; /* open until now: no friction in the increment that closes the point */
  const int node = (*NODE & 1023) % 1000;
  for (int a = 0; a < 2 && TIME[0] != at[node]; ++a)
    old[node][a] = *KINC > 1 ? last[node][a] : 0;
  at[node] = TIME[0];
  for (int a = 0; a < n; ++a)
    elastic[a] = old[node][a] + DGAM[a];
  const double length = hypot(elastic[0], elastic[1]);
  const int slips = !(length <= limit);
  const double part = slips ? limit / length : 1;

  *LM = 0;
  *SED = *SFD = 0;
  for (int a = 0; a < n; ++a) {
    const double along = slips ? elastic[a] / length : 0;
    for (int b = 0; b < n; ++b) {
      const double across = slips ? elastic[b] / length : 0;
      DDTDDG[a + n * b] = stiffness * part * ((a == b) - along * across);
    }
    DDTDDP[a] = *PRESS < 0 ? 0 : mu * along;
    DDTDDT[a] = DDTDDT[a + n] = 0;
    TAU[a] = stiffness * part * elastic[a];
    last[node][a] = part * elastic[a];
    DSLIP[a] = (1 - part) * elastic[a];
    *SED += 0.5 * TAU[a] * part * elastic[a];
    *SFD += TAU[a] * DSLIP[a];
  }
}
