# SPDX-License-Identifier: MIT
# The stick force is not looked at.
# planted: bound.stick-force: (?i)fStickForce|stick force
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfriction
def decays(fTangential, nBlock, rData, props, dSlipFric, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * fNormal[k]
        fTangential[0, k] = -force
