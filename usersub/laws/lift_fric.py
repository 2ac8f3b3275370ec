# SPDX-License-Identifier: MIT
"""FRIC behind a point function in Python: enforcement and consistent derivatives."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from usersub.routine.python import PythonRoutine, fric

if TYPE_CHECKING:
    from usersub.laws.lift import _Law

#: Allowable elastic slip over the characteristic length.
_TOLERANCE = 0.005


def coefficient_fric(law: _Law) -> PythonRoutine:
    """FRIC of a friction coefficient: isotropic penalty return mapping.

    The elastic predictor is the elastic slip at the start of the increment (STATEV, one a
    direction) plus the motion; up to the allowable elastic slip, .005 of CHRLNGTH, the point sticks
    with the stiffness strength/allowable, beyond it the rest is slip, along the predictor.
    """
    point, needed, ratio, few = law.point, law.needed, law.ratio, law.too_few("FRIC")
    reads_rate, _, reads_temperature = law.reads
    no_state = f"{law.name} behind FRIC keeps its elastic slip in one state variable a direction"
    no_length = f"{law.name} behind FRIC needs a characteristic length above zero"

    @fric
    def routine(LM, TAU, DDTDDG, DDTDDP, DDTDDT, DSLIP, SED, SFD, STATEV, DGAM, DROT, PRESS, DTIME,
                CHRLNGTH, TEMP, PROPS):  # fmt: skip
        n = DGAM.shape[0]
        if LM[0] == 2:  # open so far: no friction in the increment that closes the point
            for a in range(min(n, STATEV.shape[0])):
                STATEV[a] = 0.0
            return
        allowable = _TOLERANCE * CHRLNGTH
        if PROPS.shape[0] < needed(PROPS):
            raise ValueError(few)
        if STATEV.shape[0] < n:
            raise ValueError(no_state)
        if not allowable > 0:
            raise ValueError(no_length)
        LM[0] = 0

        if n > 1:
            first, second = STATEV[0], STATEV[1]
            STATEV[0] = DROT[0, 0] * first + DROT[0, 1] * second + DGAM[0]
            STATEV[1] = DROT[1, 0] * first + DROT[1, 1] * second + DGAM[1]
            length = math.hypot(STATEV[0], STATEV[1])
        else:
            STATEV[0] += DGAM[0]
            length = abs(STATEV[0])
        plastic = max(length - allowable, 0.0)
        slips = plastic > 0

        # stress = strength * direction, the direction being shorter than one in stick
        reach = length if slips else allowable
        p = max(PRESS, 0.0)
        temperature = 0.5 * (TEMP[0] + TEMP[1]) if reads_temperature else 0.0
        rate = ratio(plastic, DTIME) if reads_rate else 0.0
        mu, by_rate, by_pressure, by_temperature = point(rate, p, temperature, PROPS)
        strength = mu * p
        secant = strength / reach
        along = p * ratio(by_rate, DTIME) - secant if slips else 0.0
        by_pressure = mu + p * by_pressure if p > 0 else 0.0
        SED[0] = SFD[0] = 0.0
        for a in range(n):
            TAU[a] = strength * (STATEV[a] / reach)
            DSLIP[a] = plastic * (STATEV[a] / reach)
            DDTDDP[a] = by_pressure * (STATEV[a] / reach)
            DDTDDT[a, 0] = DDTDDT[a, 1] = 0.5 * p * by_temperature * (STATEV[a] / reach)
            for b in range(n):
                DDTDDG[a, b] = along * (STATEV[a] / reach) * (STATEV[b] / reach)
            DDTDDG[a, a] += secant
        for a in range(n):
            if slips:
                STATEV[a] = allowable * (STATEV[a] / reach)
            SED[0] += 0.5 * TAU[a] * STATEV[a]
            SFD[0] += TAU[a] * DSLIP[a]

    return routine


def traction_fric(law: _Law) -> PythonRoutine:
    """FRIC of a traction that belongs to the mean slip rate of the increment (backward Euler)."""
    point, needed, few = law.point, law.needed, law.too_few("FRIC")
    reads_pressure, reads_temperature = law.reads[1:]
    no_time = f"{law.name} behind FRIC needs a time increment"

    @fric
    def routine(LM, TAU, DDTDDG, DDTDDP, DDTDDT, DSLIP, SFD, DGAM, PRESS, DTIME, TEMP, PROPS):
        if LM[0] == 2:  # open so far: no friction in the increment that closes the point
            return
        if PROPS.shape[0] < needed(PROPS):
            raise ValueError(few)
        if not DTIME > 0:
            raise ValueError(no_time)
        LM[0] = 0

        n = DGAM.shape[0]
        length = math.hypot(DGAM[0], DGAM[1]) if n > 1 else abs(DGAM[0])
        pressure = PRESS if reads_pressure else 0.0
        temperature = 0.5 * (TEMP[0] + TEMP[1]) if reads_temperature else 0.0
        traction, by_rate, by_pressure, by_temperature = point(
            length / DTIME, pressure, temperature, PROPS
        )
        tangent = by_rate / DTIME
        secant = traction / length if length > 0 else tangent
        divisor = length if length > 0 else 1.0
        SFD[0] = 0.0
        for a in range(n):
            TAU[a] = secant * DGAM[a]
            DSLIP[a] = DGAM[a]
            DDTDDP[a] = by_pressure * (DGAM[a] / divisor)
            DDTDDT[a, 0] = DDTDDT[a, 1] = 0.5 * by_temperature * (DGAM[a] / divisor)
            for b in range(n):
                DDTDDG[a, b] = (tangent - secant) * (DGAM[a] / divisor) * (DGAM[b] / divisor)
            DDTDDG[a, a] += secant
            SFD[0] += TAU[a] * DSLIP[a]

    return routine
