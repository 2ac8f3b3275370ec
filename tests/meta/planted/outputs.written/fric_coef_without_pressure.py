# SPDX-License-Identifier: MIT
# For pressures of zero and below the coefficient is left as it was.
# planted: outputs.written: fCoef
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.fric_coef
def decays(fCoef, fCoefDeriv, nBlock, props, slipRate, pressure):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        change = (rest - moving) * math.exp(-decay * rate)
        if pressure[k] > 0:
            fCoef[k] = moving + change
        fCoefDeriv[k, 0] = -decay * change  # by rate, pressure, temperature
        fCoefDeriv[k, 1] = fCoefDeriv[k, 2] = 0.0
