# SPDX-License-Identifier: MIT
"""Rough friction: no slip while a point is closed. FRIC asks for it; in explicit analyses the force
is the one that ends all motion."""

import usersub


@usersub.fric
def fric(LM):
    LM[0] = 1


@usersub.vfric
def vfric(fTangential, fStickForce):
    for i in range(fStickForce.shape[0]):
        fTangential[0, i] = -fStickForce[i]


@usersub.vfriction
def vfriction(fTangential, fStickForce):
    for k in range(fStickForce.shape[0]):
        fTangential[0, k] = -fStickForce[k]
