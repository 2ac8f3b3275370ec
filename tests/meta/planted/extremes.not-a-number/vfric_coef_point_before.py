# SPDX-License-Identifier: MIT
# Where the rate is no number, the point before is answered once more.
# planted: extremes.not-a-number: (?i)nan|not a number
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    rate = 0.0
    for k in range(nBlock):
        if slipRate[k] == slipRate[k]:
            rate = slipRate[k]
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
