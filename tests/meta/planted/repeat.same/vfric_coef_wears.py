# SPDX-License-Identifier: MIT
# The routine counts its calls, and the coefficient wears with them.
# planted: repeat.same: repe|again|second
# props: 0.3, 0.2, 5
# also: repeat.order
# also: repeat.threads
# also: history.cut-back
# also: history.iterations
# also: history.save-load
# also: blocks.permute
# also: blocks.split
import math

import usersub

wear = [1.0]


@usersub.vfric_coef(compiled=False)  # to look at it in a debugger
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    wear[0] *= 0.999
    for k in range(nBlock):
        rate = slipRate[k]
        fCoef[k] = moving + wear[0] * (rest - moving) * math.exp(-decay * rate)
