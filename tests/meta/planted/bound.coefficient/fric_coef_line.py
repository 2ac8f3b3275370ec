# SPDX-License-Identifier: MIT
# The coefficient falls along a line and ends below zero.
# planted: bound.coefficient: coefficient is -
# props: 0.3, 0.2, 5
# also: extremes.*
import usersub


@usersub.fric_coef
def decays(fCoef, fCoefDeriv, nBlock, props, slipData):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipData[k, 0]
        change = (rest - moving) * (1 - decay * rate)
        fCoef[k, 0] = moving + change
        fCoefDeriv[k, 0, 0] = -decay * (rest - moving)  # by rate, pressure, temperature
        fCoefDeriv[k, 1, 0] = fCoefDeriv[k, 2, 0] = 0.0
