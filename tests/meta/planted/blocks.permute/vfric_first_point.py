# SPDX-License-Identifier: MIT
# The rate of the first point is taken for all.
# planted: blocks.permute: order|permut|place|position
# props: 0.3, 0.2, 5
# also: blocks.split
# also: extremes.not-a-number
import math

import usersub


@usersub.vfric
def decays(fTangential, nContact, dTimCur, props, dSlipFric, fStickForce, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], dTimCur
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, 0]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
