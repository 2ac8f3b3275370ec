# SPDX-License-Identifier: MIT
# The pressure is the normal force over an area that can be zero.
# planted: zero.area: (?i)nan|not a number|finite
# props: 0.3, 0.2, 5
# also: extremes.*
import math

import usersub


@usersub.vfric
def decays(
    fTangential, nContact, dTimCur, props, dSlipFric, fStickForce, fNormal, areaSec, jConSecid
):
    rest, moving, decay, dt = props[0], props[1], props[2], dTimCur
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        p = fNormal[k] / areaSec[jConSecid[k] - 1]  # less friction under high pressure
        force = mu * (1 + p) / (1 + 2 * p) * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
