# SPDX-License-Identifier: MIT
# The slip is the length of three components, also where there are two.
# planted: memory.two-dimensional: dSlipFric|out of bounds
# props: 0.3, 0.2, 0.01
# states: 1
# also: blocks.*
# also: repeat.*
# also: history.*
# also: extremes.*
import math

import usersub


@usersub.vfric
def weakens(fTangential, statev, jConSecid, nStateVar, nContact, props, dSlipFric, fStickForce,
            fNormal):  # fmt: skip
    first, last, length = props[0], props[1], props[2]
    if nStateVar < 1:
        return
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        node = jConSecid[k] - 1
        d = math.hypot(dSlipFric[0, k], dSlipFric[1, k])
        statev[0, node] += math.hypot(d, dSlipFric[2, k])
        mu = last + (first - last) * math.exp(-statev[0, node] / length)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
