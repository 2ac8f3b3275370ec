# SPDX-License-Identifier: MIT
# The properties of the first call are kept for all interactions.
# planted: repeat.order: order|before|other|props
# props: 0.3, 0.2, 5
# also: repeat.same
# also: repeat.threads
# also: history.cut-back
# also: history.iterations
# also: history.save-load
# also: blocks.permute
# also: blocks.split
import math

import usersub

kept = []


@usersub.vfriction(compiled=False)  # to look at it in a debugger
def decays(fTangential, nBlock, rData, props, dSlipFric, fStickForce, fNormal):
    if not kept:
        kept.extend(props)
    rest, moving, decay, dt = kept[0], kept[1], kept[2], rData[2]
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
