/* SPDX-License-Identifier: MIT */
/* DDTDDP is not set while the point sticks.
 * planted: outputs.written: DDTDDP
 * props: 0.3, 1000
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  const int n = *NFDIR;
  const double mu = PROPS[0], stiffness = PROPS[1];
  const double limit = mu * (*PRESS < 0 ? 0 : *PRESS) / stiffness;
  double elastic[2] = {0, 0};
  if (*LM == 2)
    return; /* open until now: no friction in the increment that closes the point */
  for (int a = 0; a < n; ++a)
    elastic[a] = TAU[a] / stiffness + DGAM[a];
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
    if (slips)
      DDTDDP[a] = *PRESS < 0 ? 0 : mu * along;
    DDTDDT[a] = DDTDDT[a + n] = 0;
    TAU[a] = stiffness * part * elastic[a];
    DSLIP[a] = (1 - part) * elastic[a];
    *SED += 0.5 * TAU[a] * part * elastic[a];
    *SFD += TAU[a] * DSLIP[a];
  }
}
