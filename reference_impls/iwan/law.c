/* SPDX-License-Identifier: MIT */
/* Iwan friction: parallel elements of spring and slider; props: coefficient, number of elements,
 * their stiffnesses, their shares of the strength. */
#define USUB_LAW "iwan"
#define USUB_LAW_PROPS iwan_props(props, count)
#define USUB_LAW_VECTORS (int)props[1]
#define USUB_LAW_READS_PRESSURE
#include <usersub/abi.h>

/* Properties that the elements take; one more than there are, if the number makes no sense. */
static int iwan_props(const usub_real *props, int count) {
  if (count < 4)
    return 4;
  return props[1] >= 1 && props[1] <= count ? 2 + 2 * (int)props[1] : count + 1;
}

#include <usersub/bristle_law.h>
#include <usersub/law_functions.h>

USUB_BRISTLE_FUNCTION {
  const int n = (int)props[1];
  for (int i = 0; i < n; ++i) {
    const usub_real stiffness = props[2 + i], share = props[2 + n + i];
    const usub_real limit = share * props[0] * pressure;
    usub_real trial[2] = {vectors[i][0] + stiffness * motion[0],
                          vectors[i][1] + stiffness * motion[1]};
    usub_real size = hypot(trial[0], trial[1]), unit = 1;
    if (!(size - size == 0)) { /* beyond the largest number: as a length */
      unit = stiffness;
      for (int a = 0; a < 2; ++a)
        trial[a] = vectors[i][a] / unit + motion[a];
      size = hypot(trial[0], trial[1]);
    }
    const int slips = unit != 1 || !(size < limit);
    /* Left at its limit by a slip, it is above by rounding: at rest its tangent is that of stick.
     */
    const int sticks = !slips || (unit == 1 && limit > 0 && size <= limit * USUB_ROUNDED);
    const usub_real along[2] = {size > 0 ? trial[0] / size : 0, size > 0 ? trial[1] / size : 0};
    const usub_real turning =
        size > 0 ? stiffness * (limit / size) / unit : 0; /* across the traction */
    for (int a = 0; a < 2; ++a) {
      vectors[i][a] = slips ? limit * along[a] : trial[a];
      traction[a] += vectors[i][a];
    }
    if (!tangent)
      continue;
    if (sticks) {
      tangent[0][0] += stiffness;
      tangent[1][1] += stiffness;
      continue;
    }
    tangent[0][0] += turning * along[1] * along[1];
    tangent[0][1] -= turning * along[1] * along[0];
    tangent[1][0] -= turning * along[0] * along[1];
    tangent[1][1] += turning * along[0] * along[0];
    tangent[0][2] += share * props[0] * along[0];
    tangent[1][2] += share * props[0] * along[1];
  }
}
