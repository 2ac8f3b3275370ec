/* SPDX-License-Identifier: MIT */
/* LuGre friction: a bristle with damping, Stribeck curve and viscous friction;
 * props: mus, muk, vs, delta, sigma0, sigma1, sigma2. */
#define USUB_LAW "lugre"
#define USUB_LAW_PROPS 7
#define USUB_LAW_VECTORS 1
#define USUB_LAW_READS_PRESSURE
#define USUB_LAW_READS_TIME
#include <usersub/bristle_law.h>
#include <usersub/law_functions.h>

USUB_BRISTLE_FUNCTION {
  const usub_real stiffness = props[4], damping = props[5], viscosity = props[6];
  const usub_real per_time = time_increment > 0 ? 1 / time_increment : 0;
  const usub_real length = hypot(motion[0], motion[1]), rate = length * per_time;
  usub_real mu_by_rate;
  const usub_real mu = usub_stribeck(rate, props[0], props[1], props[2], props[3], &mu_by_rate);
  const usub_real strength = pressure * mu, limit = strength / stiffness;
  usub_real *z = vectors[0], along[2] = {0, 0};
  for (int a = 0; a < 2; ++a) {
    along[a] = length > 0 ? motion[a] / length : 0;
    traction[a] = viscosity * per_time * motion[a];
    if (tangent)
      tangent[a][a] = viscosity * per_time;
  }
  if (!(limit > USUB_TINY)) { /* the bristle carries nothing, but it will with the pressure */
    for (int a = 0; a < 2; ++a) {
      z[a] = 0;
      if (tangent)
        tangent[a][2] = mu * along[a];
    }
    return;
  }
  usub_real x = stiffness * length / strength;
  if (!(x > 0)) { /* at rest: the derivative is that of each component from above */
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2 && tangent; ++b)
        tangent[a][b] += (stiffness + damping * per_time) * ((a == b) - z[a] / limit);
      z[a] += motion[a];
      traction[a] += stiffness * z[a] + damping * per_time * motion[a];
    }
    return;
  }
  x = x < (usub_real)1e30 ? x : (usub_real)1e30;
  const usub_real kept = exp(-x), gone = -expm1(-x), across[2] = {-along[1], along[0]};
  const usub_real strength_by_length = pressure * mu_by_rate * per_time;
  const usub_real x_by_length = (stiffness - x * strength_by_length) / strength;
  for (int a = 0; a < 2; ++a) {
    const usub_real bend = along[a] - z[a] / limit; /* how far from steady slip */
    const usub_real speed = kept * rate * bend;     /* of z, at the end */
    for (int b = 0; b < 2 && tangent; ++b)
      tangent[a][b] +=
          /* along the motion: of z, of its speed; then across it */
          (strength * kept * bend * x_by_length + gone * strength_by_length * along[a] +
           damping * (kept * per_time * (along[a] - (1 - rate * mu_by_rate / mu) * z[a] / limit) -
                      speed * x_by_length)) *
              along[b] +
          (strength * (gone / length) + damping * kept * per_time) * across[a] * across[b];
    if (tangent)
      tangent[a][2] = mu * (gone * along[a] - x * kept * bend) +
                      damping * kept * rate * (x * bend + z[a] / limit) / pressure;
    z[a] = kept * z[a] + gone * limit * along[a];
    traction[a] += stiffness * z[a] + damping * speed;
  }
}
