# SPDX-License-Identifier: MIT
# The decay goes with the square of the rate.
# planted: law.agrees: (?i)exponential_decay|agree|law
# props: 0.3, 0.2, 5
# law: exponential_decay
import math

import usersub


@usersub.fric_coef
def decays(fCoef, fCoefDeriv, nBlock, props, slipData):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipData[k, 0]
        change = (rest - moving) * math.exp(-((decay * rate) ** 2))
        fCoef[k, 0] = moving + change
        fCoefDeriv[k, 0, 0] = -2 * decay**2 * rate * change  # by rate, pressure, temperature
        fCoefDeriv[k, 1, 0] = fCoefDeriv[k, 2, 0] = 0.0
