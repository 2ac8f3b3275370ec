# SPDX-License-Identifier: MIT
# FRIC_COEF, legacy: decay by slip rate; props: coefficient at rest, at high rate, decay
# (time/length).
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.fric_coef
def decays(fCoef, fCoefDeriv, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        change = (rest - moving) * math.exp(-decay * rate)
        fCoef[k] = moving + change
        fCoefDeriv[k, 0] = -decay * change  # by rate, pressure, temperature
        fCoefDeriv[k, 1] = fCoefDeriv[k, 2] = 0.0
