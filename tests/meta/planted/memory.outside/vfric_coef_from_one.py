# SPDX-License-Identifier: MIT
# The loop over the points begins with 1 and ends with their number, as in Fortran.
# planted: memory.outside: slipRate|fCoef|out of bounds
# props: 0.3, 0.2, 5
# also: outputs.written
# also: blocks.*
# also: repeat.*
# also: history.*
# also: extremes.*
import math

import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(1, nBlock + 1):
        rate = slipRate[k]
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
