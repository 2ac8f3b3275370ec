# SPDX-License-Identifier: MIT
# The coefficient falls along a line and ends below zero.
# planted: bound.coefficient: coefficient is -
# props: 0.3, 0.2, 5
# also: extremes.*
import usersub


@usersub.vfric_coef
def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        fCoef[k] = rest - (rest - moving) * decay * rate
