# SPDX-License-Identifier: MIT
# The main surface is taken to have facets of four nodes; an edge has two.
# planted: memory.edges: shapeMain|coordMain|out of bounds
# props: 0.3, 0.2, 0.01
# states: 2
# also: blocks.permute
# also: blocks.split
# also: repeat.same
# also: repeat.order
# also: repeat.threads
# also: history.save-load
# also: blocks.*
# also: repeat.*
# also: history.*
# also: extremes.*
import math

import usersub


@usersub.vfriction
def weakens(
    fTangential, state, nStates, nNodState, nNodMain, nBlock, props, dSlipFric, fStickForce,
    fNormal, shapeMain, coordMain
):  # fmt: skip
    first, last, length = props[0], props[1], props[2]
    if nStates < 1:
        return
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        for i in range(nNodState):  # four times the same behind edges
            state[0, i, k] += dSlipFric[0, k]
        if nStates > 1 and nNodMain > 1:  # height of the main surface
            state[1, 0, k] = 0.0
            for i in range(4):
                state[1, 0, k] += shapeMain[i, k] * coordMain[2, i, k]
        mu = last + (first - last) * math.exp(-state[0, 0, k] / length)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
