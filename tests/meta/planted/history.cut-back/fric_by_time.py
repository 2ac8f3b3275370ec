# SPDX-License-Identifier: MIT
# The elastic slip is kept by node inside the routine and taken over when the time moves, a cut-
# back included.
# planted: history.cut-back: thrown away
# props: 0.3, 1000
# also: repeat.order
# also: repeat.same
# also: repeat.threads
# also: history.iterations
# also: history.save-load
# also: blocks.permute
# also: blocks.split
import math

import usersub

old, last, at = {}, {}, {}  # elastic slip by node


@usersub.fric(compiled=False)  # to look at it in a debugger
def coulomb(
    LM, TAU, DDTDDG, DDTDDP, DSLIP, SED, SFD, DDTDDT, DGAM, KINC, TIME, NODE, PRESS, PROPS, NFDIR
):
    if LM[0] == 2:
        return  # open until now: no friction in the increment that closes the point
    mu, stiffness = PROPS[0], PROPS[1]
    limit = 0.0 if PRESS < 0 else mu * PRESS / stiffness
    if TIME[0] != at.get(NODE):
        old[NODE] = last.get(NODE, (0.0, 0.0)) if KINC > 1 else (0.0, 0.0)
        at[NODE] = TIME[0]
    x = old[NODE][0] + DGAM[0]
    y = old[NODE][1] + DGAM[1] if NFDIR == 2 else 0.0
    length = math.hypot(x, y)
    slips = not length <= limit
    part = limit / length if slips else 1.0
    along = (x / length, y / length) if slips else (0.0, 0.0)

    LM[0] = 0
    last[NODE] = (part * x, part * y)
    SED[0] = SFD[0] = 0.0
    for a in range(NFDIR):
        elastic = x if a == 0 else y
        for b in range(NFDIR):
            DDTDDG[a, b] = stiffness * part * ((a == b) - along[a] * along[b])
        DDTDDP[a] = 0.0 if PRESS < 0 else mu * along[a]
        DDTDDT[a, 0] = DDTDDT[a, 1] = 0.0
        TAU[a] = stiffness * part * elastic
        DSLIP[a] = (1 - part) * elastic
        SED[0] += 0.5 * TAU[a] * part * elastic
        SFD[0] += TAU[a] * DSLIP[a]
