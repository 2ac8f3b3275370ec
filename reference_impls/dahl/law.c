/* SPDX-License-Identifier: MIT */
/* Dahl friction: a bristle that bends and slips; props: coefficient, stiffness. */
#define USUB_LAW "dahl"
#define USUB_LAW_PROPS 2
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#include <usersub/bristle_law.h>
#include <usersub/law_functions.h>

USUB_BRISTLE_FUNCTION {
  const usub_real strength = props[0] * pressure, stiffness = props[1];
  const usub_real limit = strength / stiffness, length = hypot(motion[0], motion[1]);
  usub_real *z = vectors[0], along[2] = {0, 0};
  for (int a = 0; a < 2 && length > 0; ++a)
    along[a] = motion[a] / length;
  if (!(limit > USUB_TINY)) { /* no traction, but it grows with the pressure */
    for (int a = 0; a < 2; ++a) {
      z[a] = 0;
      if (tangent)
        tangent[a][2] = props[0] * along[a];
    }
    return;
  }
  usub_real x = stiffness * length / strength;
  if (!(x > 0)) { /* at rest: the derivative is that of each component from above */
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2 && tangent; ++b)
        tangent[a][b] = stiffness * ((a == b) - z[a] / limit);
      z[a] += motion[a];
      traction[a] = stiffness * z[a];
    }
    return;
  }
  x = x < (usub_real)1e30 ? x : (usub_real)1e30;
  const usub_real kept = exp(-x), gone = -expm1(-x), across[2] = {-along[1], along[0]};
  for (int a = 0; a < 2; ++a) {
    const usub_real bend = along[a] - z[a] / limit; /* how far from steady slip */
    for (int b = 0; b < 2 && tangent; ++b)
      tangent[a][b] =
          stiffness * kept * bend * along[b] + strength * (gone / length) * across[a] * across[b];
    if (tangent)
      tangent[a][2] = props[0] * (gone * along[a] - x * kept * bend);
    z[a] = kept * z[a] + gone * limit * along[a];
    traction[a] = stiffness * z[a];
  }
}
