# SPDX-License-Identifier: MIT
# The temperature of the main surface is read for every point; an analytical rigid surface has
# one.
# planted: memory.analytical-rigid: temp|out of bounds
# props: 0.3, 0.2, 5
# also: blocks.*
# also: repeat.*
# also: history.*
# also: extremes.*
import math

import usersub


@usersub.vfriction
def decays(
    fTangential, nBlock, nTemp, rData, props, dSlipFric, fStickForce, fNormal, tempSec, tempMain
):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        mean = 0.5 * (tempSec[k] + tempMain[k]) if nTemp > 0 else 0.0
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * math.exp(-0.002 * mean) * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
