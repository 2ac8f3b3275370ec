# SPDX-License-Identifier: MIT
# A fourth property is read without a look at nProps.
# planted: memory.properties: props|out of bounds
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric
def decays(fTangential, nContact, dTimCur, props, dSlipFric, fStickForce, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], dTimCur
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = (rest if props[3] == 7 else mu) * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
