# SPDX-License-Identifier: MIT
# Written with growing exponentials, the law has no value at high rates.
# planted: extremes.finite: (?i)nan|not a number|finite|inf
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfriction
def decays(fTangential, nBlock, rData, props, dSlipFric, fStickForce, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        grows = math.exp(decay * rate)
        mu = (rest + moving * (grows - 1)) / grows
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
