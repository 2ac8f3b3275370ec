# SPDX-License-Identifier: MIT
# Every call writes a line.
# planted: process.output: (?i)writ|print|line
# props: 0.3, 0.2, 5
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        print("rate", rate)
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
