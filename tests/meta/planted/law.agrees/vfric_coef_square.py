# SPDX-License-Identifier: MIT
# The decay goes with the square of the rate.
# planted: law.agrees: (?i)exponential_decay|agree|law
# props: 0.3, 0.2, 5
# law: exponential_decay
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        fCoef[k] = moving + (rest - moving) * math.exp(-((decay * rate) ** 2))
