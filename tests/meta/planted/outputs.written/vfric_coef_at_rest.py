# SPDX-License-Identifier: MIT
# A point that does not move is skipped, and with it its coefficient.
# planted: outputs.written: fCoef
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        if rate == 0:
            continue
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
