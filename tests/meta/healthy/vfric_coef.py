# SPDX-License-Identifier: MIT
# VFRIC_COEF: decay by slip rate; props: coefficient at rest, at high rate, decay (time/length).
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
