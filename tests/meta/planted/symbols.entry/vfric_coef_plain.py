# SPDX-License-Identifier: MIT
# The decorator is forgotten.
# planted: symbols.entry: interface|decorat
# props: 0.3, 0.2, 5
import math


def decays(fCoef, nBlock, props, slipRate):
    rest, moving, decay = props[0], props[1], props[2]
    for k in range(nBlock):
        rate = slipRate[k]
        fCoef[k] = moving + (rest - moving) * math.exp(-decay * rate)
