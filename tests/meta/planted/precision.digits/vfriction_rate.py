# SPDX-License-Identifier: MIT
# The rate is kept in single precision, also where the solver works in double.
# planted: precision.digits: (?i)digit|single
# props: 0.3, 0.2, 5
# precision: double
import math

import numpy as np

import usersub


@usersub.vfriction
def decays(fTangential, nBlock, rData, props, dSlipFric, fStickForce, fNormal):
    rest, moving, decay, dt = props[0], props[1], props[2], rData[2]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        slip = dSlipFric[0, k]
        rate = np.float32(slip / dt if dt > 0 else 0.0)
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
