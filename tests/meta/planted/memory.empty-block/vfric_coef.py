# SPDX-License-Identifier: MIT
# The loop runs once before it looks at the number of points.
# planted: memory.empty-block: nBlock = 0
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    k = 0
    while True:
        rate = slipRate[k]
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
        k += 1
        if k >= nBlock:
            break
