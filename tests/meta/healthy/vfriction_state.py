# SPDX-License-Identifier: MIT
# VFRICTION: weakens with the slip of the point; props: coefficient at first, in the end, slip
# (length).
# props: 0.3, 0.2, 0.01
# states: 1
import math

import usersub


@usersub.vfriction
def weakens(fTangential, state, nStates, nNodState, nBlock, props, dSlipFric, fStickForce,
            fNormal):  # fmt: skip
    first, last, length = props[0], props[1], props[2]
    if nStates < 1:
        return
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        for i in range(nNodState):  # four times the same behind edges
            state[0, i, k] += dSlipFric[0, k]
        mu = last + (first - last) * math.exp(-state[0, 0, k] / length)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
