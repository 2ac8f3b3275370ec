# SPDX-License-Identifier: MIT
# The stick force is not looked at.
# planted: bound.stick-force: (?i)fStickForce|stick force
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric
def decays(fTangential, nContact, dTimCur, props, dSlipFric, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], dTimCur
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = slip / dt if dt > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * fNormal[k]
        fTangential[0, k] = -force
