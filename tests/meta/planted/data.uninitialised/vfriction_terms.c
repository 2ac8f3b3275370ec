/* SPDX-License-Identifier: MIT */
/* The second of two terms is never set.
 * planted: data.uninitialised: (?i)uninitiali|not set|local
 * props: 0.3, 0.2, 5
 * also: precision.digits
 */
#include <math.h>
#include <usersub/abi.h>

static __attribute__((noinline)) double sum_of(const volatile double *terms, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i)
    sum += terms[i];
  return sum;
}

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  const double rest = props[0], moving = props[1], decay = props[2], dt = rData[2];
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double slip = dSlipFric[*nDir * k], rate = dt > 0 ? slip / dt : 0;
    const double mu = moving + (rest - moving) * exp(-decay * rate);
    double terms[2], force = mu * fNormal[k];
    terms[0] = force;
    force = sum_of(terms, 2);
    if (force > fStickForce[k])
      force = fStickForce[k];
    fTangential[*nFricDir * k] = (usub_real)-force;
  }
}
