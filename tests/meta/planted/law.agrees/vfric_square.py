# SPDX-License-Identifier: MIT
# The decay goes with the square of the rate.
# planted: law.agrees: (?i)exponential_decay|agree|law
# props: 0.3, 0.2, 5
# law: exponential_decay
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
        mu = moving + (rest - moving) * math.exp(-((decay * rate) ** 2))
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
