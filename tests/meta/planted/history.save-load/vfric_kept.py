# SPDX-License-Identifier: MIT
# The slip is kept by node inside the routine, where no restart finds it; statev gets a copy.
# planted: history.save-load: load|restart|save
# props: 0.3, 0.2, 0.01
# states: 1
# also: repeat.order
# also: repeat.same
# also: repeat.threads
# also: history.cut-back
# also: history.iterations
# also: blocks.permute
# also: blocks.split
import math

import usersub

kept = {}  # slip by node


@usersub.vfric(compiled=False)  # to look at it in a debugger
def weakens(fTangential, statev, jConSecid, nStateVar, nContact, props, dSlipFric, fStickForce,
            fNormal, jSecUid, timStep, dTimCur):  # fmt: skip
    first, last, length = props[0], props[1], props[2]
    if nStateVar < 1:
        return
    for k in range(nContact):
        if fNormal[k] <= 0:
            continue
        node = jConSecid[k] - 1
        before = kept.get(jSecUid[node], 0.0) if timStep > dTimCur else 0.0
        statev[0, node] = kept[jSecUid[node]] = before + dSlipFric[0, k]
        mu = last + (first - last) * math.exp(-statev[0, node] / length)
        force = mu * fNormal[k]
        if force > fStickForce[k]:
            force = fStickForce[k]
        fTangential[0, k] = -force
