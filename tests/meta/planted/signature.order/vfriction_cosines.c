/* SPDX-License-Identifier: MIT */
/* Normal and slip direction stand in the order of VFRIC.
 * planted: signature.order: (?i)dircos
 * props: 0.3, 0.2, 5
 * states: 3
 */
#include <math.h>
#include <usersub/abi.h>

void FOR_NAME(vfriction, VFRICTION)(
    usub_real *fTangential, usub_real *state, const int *nBlock, const int *nBlockAnal,
    const int *nBlockEdge, const int *nNodState, const int *nNodSec, const int *nNodMain,
    const int *nFricDir, const int *nDir, const int *nStates, const int *nProps,
    const int *nTemp, const int *nFields, const int *jFlags, const usub_real *rData,
    const char *surfInt, const char *surfSec, const char *surfMain, const int *jConSecUid,
    const int *jConMainUid, const usub_real *props, const usub_real *dSlipFric,
    const usub_real *fStickForce, const usub_real *fTangPrev, const usub_real *fNormal,
    const usub_real *areaCont, const usub_real *dircosSl, const usub_real *dircosN,
    const usub_real *shapeSec, const usub_real *shapeMain, const usub_real *coordSec,
    const usub_real *coordMain, const usub_real *velSec, const usub_real *velMain,
    const usub_real *tempSec, const usub_real *tempMain, const usub_real *fieldSec,
    const usub_real *fieldMain) {
  for (int k = 0; k < *nBlock; ++k) {
    if (fNormal[k] <= 0)
      continue;
    const double rate = rData[2] > 0 ? dSlipFric[*nDir * k] / rData[2] : 0;
    const double force = (props[1] + (props[0] - props[1]) * exp(-props[2] * rate)) * fNormal[k];
    fTangential[*nFricDir * k] = (usub_real)(force > fStickForce[k] ? -fStickForce[k] : -force);
    for (int i = 0; i < *nDir && i < *nStates; ++i)
      state[i + *nStates * *nNodState * k] += dSlipFric[*nDir * k] * dircosSl[i + *nDir * k];
  }
}
