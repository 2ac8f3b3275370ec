# SPDX-License-Identifier: MIT
# The coefficient is that of the fastest point of the block.
# planted: blocks.split: block|split|call
# props: 0.3, 0.2, 5
# also: extremes.not-a-number
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    rate = 0.0
    for k in range(nBlock):
        rate = rate if slipRate[k] <= rate else slipRate[k]
    for k in range(nBlock):
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
