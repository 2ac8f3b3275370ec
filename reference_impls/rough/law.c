/* SPDX-License-Identifier: MIT */
/* Rough friction: no slip while a point is closed. FRIC asks for it; in explicit analyses the force
 * is the one that ends all motion. */
#include <usersub/abi.h>

void FOR_NAME(vfric, VFRIC)(USUB_VFRIC_PARAMETERS) {
  for (int i = 0; i < *nContact; ++i)
    fTangential[(ptrdiff_t)i * *nFricDir] = -fStickForce[i];
}

void FOR_NAME(vfriction, VFRICTION)(USUB_VFRICTION_PARAMETERS) {
  for (int k = 0; k < *nBlock; ++k)
    fTangential[(ptrdiff_t)k * *nFricDir] = -fStickForce[k];
}

#ifndef USUB_SINGLE
void FOR_NAME(fric, FRIC)(USUB_FRIC_PARAMETERS) {
  *LM = 1;
}
#endif
