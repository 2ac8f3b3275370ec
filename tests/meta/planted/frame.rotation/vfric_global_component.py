# SPDX-License-Identifier: MIT
# The slip is summed in its first global component only, so the weakening depends on the axes.
# planted: frame.rotation: rotat|turn|axes|frame
# props: 0.3, 0.2, 0.01
# states: 1
import math

import usersub


@usersub.vfric
def weakens(fTangential, statev, jConSecid, nStateVar, nContact, props, dSlipFric, fStickForce,
            fNormal, dirCosSl):  # fmt: skip
    first, last, length = props[0], props[1], props[2]
    if nStateVar < 1:
        return
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        node = jConSecid[k] - 1
        statev[0, node] += dSlipFric[0, k] * abs(dirCosSl[0, k])
        mu = last + (first - last) * math.exp(-statev[0, node] / length)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
