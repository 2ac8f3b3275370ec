# SPDX-License-Identifier: MIT
# The stress follows the whole displacement along a curve, up and down: a slid body creeps back.
# planted: energy.push-release: (?i)work|release|creep|back
# props: 0.3, 1000
# states: 2
# also: energy.*
# also: slip.*
# also: frame.turn
# also: memory.state
# also: bound.*
import math

import usersub


@usersub.fric
def coulomb(LM, TAU, DDTDDG, DDTDDP, DSLIP, SED, SFD, DDTDDT, STATEV, DGAM, PRESS, PROPS, NFDIR):
    if LM[0] == 2:
        return  # open until now: no friction in the increment that closes the point
    mu, stiffness = PROPS[0], PROPS[1]
    limit = 0.0 if PRESS < 0 else mu * PRESS / stiffness
    for a in range(NFDIR):
        STATEV[a] += DGAM[a]  # since the start
    x, y = STATEV[0], STATEV[1] if NFDIR == 2 else 0.0
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
        DDTDDP[a] = 0.0 if PRESS < 0 else mu * along[a]
        DDTDDT[a, 0] = DDTDDT[a, 1] = 0.0
        TAU[a] = stiffness * part * elastic
        DSLIP[a] = 0.0
        SED[0] += 0.5 * TAU[a] * part * elastic
        SFD[0] += TAU[a] * DSLIP[a]
