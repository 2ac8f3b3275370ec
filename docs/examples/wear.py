# SPDX-License-Identifier: MIT
"""Friction that rises as the surface wears, as a FRIC routine with two state variables.

PROPS: 1 coefficient of the fresh surface, 2 coefficient of the worn surface, 3 energy per area that
wears it (energy/area), 4 stiffness of elastic stick (stress/length).
STATEV: 1 dissipated energy per area, 2 largest friction stress so far.
"""

import math

import usersub


@usersub.fric
def wear(LM, TAU, DDTDDG, DDTDDP, DSLIP, SFD, STATEV, DGAM, PRESS, PROPS, NFDIR):
    fresh, worn, energy, stiffness = PROPS[0], PROPS[1], PROPS[2], PROPS[3]
    mu = worn + (fresh - worn) * math.exp(-STATEV[0] / energy)  # wear at the start of the increment
    critical = mu * max(PRESS, 0.0)

    size = 0.0
    for a in range(NFDIR):
        TAU[a] += stiffness * DGAM[a]
        size += TAU[a] ** 2
    size = math.sqrt(size)
    slides = size > critical
    factor = critical / size if slides else 1.0

    LM[0] = 0
    SFD[0] = 0.0
    for a in range(NFDIR):
        for b in range(NFDIR):
            DDTDDG[a, b] = factor * stiffness if a == b else 0.0
            if slides:
                DDTDDG[a, b] -= factor * stiffness * TAU[a] * TAU[b] / size**2
        DDTDDP[a] = mu * TAU[a] / size if slides else 0.0
    for a in range(NFDIR):
        DSLIP[a] = (1.0 - factor) * TAU[a] / stiffness
        TAU[a] *= factor
        SFD[0] += TAU[a] * DSLIP[a]
    STATEV[0] += SFD[0]
    STATEV[1] = max(STATEV[1], factor * size)
