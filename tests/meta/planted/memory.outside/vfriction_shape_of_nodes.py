# SPDX-License-Identifier: MIT
# The shape functions of the secondary side are read for nodes too; only edges have them.
# planted: memory.outside: shapeSec|out of bounds
# props: 0.3, 0.2, 5
# also: blocks.*
# also: repeat.*
# also: history.*
# also: extremes.*
import math

import usersub


@usersub.vfriction
def decays(fTangential, nBlock, rData, props, dSlipFric, fStickForce, fNormal, shapeSec):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        share = 0.0 if shapeSec[0, k] < -2 else 1.0
        force = mu * share * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
