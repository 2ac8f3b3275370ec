# SPDX-License-Identifier: MIT
# At the first number that is none the routine goes home, and the points after it have no
# friction.
# planted: extremes.not-a-number: (?i)nan|not a number
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfriction
def decays(fTangential, nBlock, rData, props, dSlipFric, fStickForce, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if math.isnan(fNormal[k]) or math.isnan(dSlipFric[0, k]):
            return
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
