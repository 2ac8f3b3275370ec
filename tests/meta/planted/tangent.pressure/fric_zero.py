# SPDX-License-Identifier: MIT
# The derivative by pressure is left at zero.
# planted: tangent.pressure: DDTDDP
# props: 0.3, 1000
import math

import usersub


@usersub.fric
def coulomb(LM, TAU, DDTDDG, DDTDDP, DSLIP, SED, SFD, DDTDDT, DGAM, PRESS, PROPS, NFDIR):
    if LM[0] == 2:
        return  # open until now: no friction in the increment that closes the point
    mu, stiffness = PROPS[0], PROPS[1]
    limit = 0.0 if PRESS < 0 else mu * PRESS / stiffness
    x = TAU[0] / stiffness + DGAM[0]
    y = TAU[1] / stiffness + DGAM[1] if NFDIR == 2 else 0.0
    length = math.hypot(x, y)
    slips = not length <= limit
    part = limit / length if slips else 1.0
    along = (x / length, y / length) if slips else (0.0, 0.0)

    LM[0] = 0
    SED[0] = SFD[0] = 0.0
    for a in range(NFDIR):
        elastic = x if a == 0 else y
        for b in range(NFDIR):
            DDTDDG[a, b] = stiffness * part * ((a == b) - along[a] * along[b])
        DDTDDP[a] = 0.0
        DDTDDT[a, 0] = DDTDDT[a, 1] = 0.0
        TAU[a] = stiffness * part * elastic
        DSLIP[a] = (1 - part) * elastic
        SED[0] += 0.5 * TAU[a] * part * elastic
        SFD[0] += TAU[a] * DSLIP[a]
