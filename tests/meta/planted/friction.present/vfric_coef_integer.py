# SPDX-License-Identifier: MIT
# The coefficient is kept in an integer and is zero.
# planted: friction.present: is 0 in all
# props: 0.3, 0.2, 5
# also: precision.digits
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        fCoef[k] = int(moving + (rest - moving) * math.exp(-decay * rate))
