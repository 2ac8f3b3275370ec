# SPDX-License-Identifier: MIT
# The slip of the increment is divided by the step time.
# planted: limits.rate: step time
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfriction
def step_time(fTangential, nBlock, props, rData, dSlipFric, fStickForce, fNormal):
    rest, moving, decay, time = props[0], props[1], props[2], rData[0]
    for k in range(nBlock):
        if fNormal[k] <= 0:
            continue
        rate = dSlipFric[0, k] / time if time > 0 else 0.0
        mu = moving + (rest - moving) * math.exp(-decay * rate)
        fTangential[0, k] = -min(mu * fNormal[k], fStickForce[k])
