# SPDX-License-Identifier: MIT
# The second component is left over from the last increment.
# planted: bound.cone: expected at most
# props: 0.3, 0.2, 5
# also: frame.*
# also: bound.opposes-slip
# also: bound.stick-force
# also: energy.*
import math

import usersub


@usersub.vfriction
def decays(fTangential, nBlock, rData, props, dSlipFric, fStickForce, fNormal, fTangPrev):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
        fTangential[1, k] = fTangPrev[1, k]
