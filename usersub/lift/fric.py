# SPDX-License-Identifier: MIT
"""FRIC of laws along the slip: enforcement and consistent derivatives."""

from __future__ import annotations

import math
from collections.abc import Callable

from usersub.lift.description import STRENGTH
from usersub.lift.kernels import Parts, clear, mean_fields, ratio

#: Allowable elastic slip over the characteristic length.
TOLERANCE = 0.005
#: An elastic slip that was left at its limit is rounded: at rest it must not slip again.
ROUNDED = 1.0 + 4.0 * 2.220446049250313e-16


def turn(statev, drot, dgam):
    """Elastic predictor in place of the elastic slip: turned with the surface, plus the motion."""
    if dgam.shape[0] > 1:
        first, second = statev[0], statev[1]
        statev[0] = drot[0, 0] * first + drot[0, 1] * second + dgam[0]
        statev[1] = drot[1, 0] * first + drot[1, 1] * second + dgam[1]
    else:
        statev[0] += dgam[0]


def assign(array, n, x, y):
    """Writes one or two components."""
    array[0] = x
    if n > 1:
        array[1] = y


def assign_tangent(ddtddg, n, all_ways, along, x, y):
    """Writes a stiffness that is the same in all directions plus one along the unit vector."""
    ddtddg[0, 0] = all_ways + along * x * x
    if n > 1:
        ddtddg[0, 1] = ddtddg[1, 0] = along * x * y
        ddtddg[1, 1] = all_ways + along * y * y


def penalty(parts: Parts) -> Callable:
    """FRIC of a friction coefficient or a strength: isotropic penalty return mapping.

    The elastic predictor is the elastic slip at the start of the increment (STATEV, one a
    direction) plus the motion; up to the allowable elastic slip, .005 of CHRLNGTH, the point sticks
    with the stiffness strength/allowable, beyond it the rest is slip, along the predictor.
    """
    evaluate, needed, scalars = parts.evaluate, parts.needed, parts.scalars
    law, few = parts.law, parts.too_few("FRIC")
    no_state = f"{law.name} behind FRIC keeps its elastic slip in one state variable a direction"
    no_length = f"{law.name} behind FRIC needs a characteristic length above zero"
    stateful, is_strength = law.reads("state"), law.kind == STRENGTH
    temperatures, fields = law.reads("temperature"), law.reads("fields")
    rates = law.reads("slip_rate")
    negative = f"{law.name} behind FRIC returns a {law.kind} below zero"
    overflow = f"{law.name} behind FRIC: coefficient times pressure overflows"
    if stateful:
        no_state += ", and its own state variables behind it"

    def routine(LM, TAU, DDTDDG, DDTDDP, DDTDDT, DSLIP, SED, SFD, STATEV, DGAM, DROT, PRESS, DTIME,
                CHRLNGTH, TEMP, PREDEF, PROPS):  # fmt: skip
        n = DGAM.shape[0]
        if LM[0] == 2:  # open so far: no friction in the increment that closes the point
            clear(STATEV)
            return
        allowable = TOLERANCE * CHRLNGTH
        if PROPS.shape[0] < needed(PROPS):
            raise ValueError(few)
        if STATEV.shape[0] < n + scalars(PROPS):
            raise ValueError(no_state)
        if not allowable > 0:
            raise ValueError(no_length)
        LM[0] = 0

        turn(STATEV, DROT, DGAM)
        length = math.hypot(STATEV[0], STATEV[1]) if n > 1 else abs(STATEV[0])
        slips = length > allowable * ROUNDED
        plastic = length - allowable if slips else 0.0

        # stress = strength * direction, the direction being shorter than one in stick
        reach = max(length, allowable)
        p = max(PRESS, 0.0)
        value, by_rate, by_pressure, by_temperature, by_slip = evaluate(
            ratio(plastic, DTIME) if rates else 0.0,
            p,
            0.5 * (TEMP[0] + TEMP[1]) if temperatures else 0.0,
            mean_fields(PREDEF) if fields else PROPS,
            plastic,
            DTIME,
            STATEV[n : n + scalars(PROPS)] if stateful else PROPS,
            PROPS,
        )
        if value < 0:
            raise ValueError(negative)
        factor = 1.0 if is_strength else p
        strength = value * factor
        if strength == math.inf:
            raise ValueError(overflow)
        secant = strength / reach
        along = factor * (ratio(by_rate, DTIME) + by_slip) - secant if slips else 0.0
        by_pressure = factor * by_pressure + (0.0 if is_strength else value)
        if PRESS < 0:
            by_pressure = 0.0
        x = STATEV[0] / reach
        y = STATEV[1] / reach if n > 1 else 0.0
        assign(TAU, n, strength * x, strength * y)
        assign(DSLIP, n, plastic * x, plastic * y)
        assign(DDTDDP, n, by_pressure * x, by_pressure * y)
        both = 0.5 * factor * by_temperature
        for surface in range(2):
            assign(DDTDDT[:, surface], n, both * x, both * y)
        assign_tangent(DDTDDG, n, secant, along, x, y)
        if slips:
            assign(STATEV, n, allowable * x, allowable * y)
        elastic = allowable if slips else length
        SED[0] = 0.5 * strength * elastic * (length / reach)
        SFD[0] = strength * plastic

    return routine


def traction(parts: Parts) -> Callable:
    """FRIC of a traction that belongs to the mean slip rate of the increment (backward Euler)."""
    evaluate, needed, scalars = parts.evaluate, parts.needed, parts.scalars
    law, few, few_states = parts.law, parts.too_few("FRIC"), parts.too_few_states("FRIC")
    no_time = f"{law.name} behind FRIC needs a time increment"
    stateful, times = law.reads("state"), law.reads("slip_rate", "time_increment")
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(LM, TAU, DDTDDG, DDTDDP, DDTDDT, DSLIP, SFD, STATEV, DGAM, PRESS, DTIME, TEMP,
                PREDEF, PROPS):  # fmt: skip
        if LM[0] == 2:  # open so far: no friction in the increment that closes the point
            clear(STATEV)
            return
        if PROPS.shape[0] < needed(PROPS):
            raise ValueError(few)
        if STATEV.shape[0] < scalars(PROPS):
            raise ValueError(few_states)
        if times and not DTIME > 0:
            raise ValueError(no_time)
        LM[0] = 0

        n = DGAM.shape[0]
        length = math.hypot(DGAM[0], DGAM[1]) if n > 1 else abs(DGAM[0])
        value, by_rate, by_pressure, by_temperature, by_slip = evaluate(
            ratio(length, DTIME),
            max(PRESS, 0.0),
            0.5 * (TEMP[0] + TEMP[1]) if temperatures else 0.0,
            mean_fields(PREDEF) if fields else PROPS,
            length,
            DTIME,
            STATEV[: scalars(PROPS)] if stateful else PROPS,
            PROPS,
        )
        tangent = ratio(by_rate, DTIME) + by_slip
        secant = value / length if length > 0 else tangent
        divisor = length if length > 0 else 1.0
        if PRESS < 0:
            by_pressure = 0.0
        x = DGAM[0] / divisor
        y = DGAM[1] / divisor if n > 1 else 0.0
        assign(TAU, n, value * x, value * y)
        assign(DSLIP, n, DGAM[0], DGAM[n - 1])
        assign(DDTDDP, n, by_pressure * x, by_pressure * y)
        for surface in range(2):
            assign(DDTDDT[:, surface], n, 0.5 * by_temperature * x, 0.5 * by_temperature * y)
        assign_tangent(DDTDDG, n, secant, tangent - secant, x, y)
        SFD[0] = value * length

    return routine
