# SPDX-License-Identifier: MIT
"""FRIC_COEF and VFRIC_COEF of a friction coefficient."""

from __future__ import annotations

from collections.abc import Callable

from usersub.lift.kernels import Parts


def vfric_coef(parts: Parts) -> Callable:
    """VFRIC_COEF: the coefficient of each point of the block."""
    value, needed, few = parts.value, parts.needed, parts.too_few("VFRIC_COEF")
    law = parts.law
    rates, pressures = law.reads("slip_rate", "slip_increment"), law.reads("pressure")
    temperatures, times = law.reads("temperature"), law.reads("time_increment", "slip_increment")

    def routine(fCoef, nBlock, nTemp, rData, slipRate, pressure, tempAvg, fieldAvg, props):
        if props.shape[0] < needed(props):
            raise ValueError(few)
        dt = rData[2] if times else 0.0
        for k in range(nBlock):
            rate = slipRate[k] if rates else 0.0
            p = max(pressure[k], 0.0) if pressures else 0.0
            temperature = tempAvg[k] if temperatures and nTemp > 0 else 0.0
            fCoef[k] = value(rate, p, temperature, fieldAvg[k], rate * dt, dt, props, props)

    return routine


def fric_coef(parts: Parts) -> Callable:
    """FRIC_COEF of generation 2022: coefficients and derivatives; the state variables of the one
    point that a call with state has stand behind rData(7)."""
    evaluate, needed, few = parts.evaluate, parts.needed, parts.too_few("FRIC_COEF")
    few_states, scalars = parts.too_few_states("FRIC_COEF"), parts.scalars
    law = parts.law
    stateful, anisotropic = law.reads("state"), law.anisotropic
    rates, pressures = law.reads("slip_rate", "slip_increment"), law.reads("pressure")
    temperatures, times = law.reads("temperature"), law.reads("time_increment", "slip_increment")
    slips = law.reads("slip_increment")

    def routine(fCoef, fCoefDeriv, nBlock, nTemp, iData, rData, slipData, pressure, tempAvg,
                fieldAvg, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(few)
        state = props
        if stateful:
            if rData.shape[0] < 7 + scalars(props):
                raise ValueError(few_states)
            state = rData[7 : 7 + scalars(props)]
        dt = rData[2] if times else 0.0
        for k in range(nBlock):
            rate = slipData[k, 0] if rates else 0.0
            p = max(pressure[k], 0.0) if pressures else 0.0
            temperature = tempAvg[k] if temperatures and nTemp > 0 else 0.0
            found = evaluate(rate, p, temperature, fieldAvg[k], rate * dt, dt, state, props)
            if anisotropic:
                for i in range(2 if iData[5] > 1 else 1):  # with one direction the first counts
                    fCoef[k, i] = found[1] if i else found[0]
                    by = found[3] if i else found[2]
                    for j in range(3):
                        fCoefDeriv[k, j, i] = by[j]
                    if slips:
                        fCoefDeriv[k, 5, i] = by[3]
            else:
                fCoef[k, 0] = found[0]
                for j in range(3):
                    fCoefDeriv[k, j, 0] = found[1 + j]
                if slips:
                    fCoefDeriv[k, 5, 0] = found[4]

    return routine


def fric_coef_legacy(parts: Parts) -> Callable:
    """FRIC_COEF of generation legacy, which knows the slip of the increment by its rate alone."""
    evaluate, needed, few = parts.evaluate, parts.needed, parts.too_few("FRIC_COEF")
    law = parts.law
    rates, pressures = law.reads("slip_rate", "slip_increment"), law.reads("pressure")
    temperatures, times = law.reads("temperature"), law.reads("time_increment", "slip_increment")

    def routine(fCoef, fCoefDeriv, nBlock, nTemp, rData, slipRate, pressure, tempAvg, fieldAvg,
                props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(few)
        dt = rData[2] if times else 0.0
        for k in range(nBlock):
            rate = slipRate[k] if rates else 0.0
            p = max(pressure[k], 0.0) if pressures else 0.0
            temperature = tempAvg[k] if temperatures and nTemp > 0 else 0.0
            found = evaluate(rate, p, temperature, fieldAvg[k], rate * dt, dt, props, props)
            fCoef[k] = found[0]
            fCoefDeriv[k, 0] = found[1] + found[4] * dt
            fCoefDeriv[k, 1] = found[2]
            fCoefDeriv[k, 2] = found[3]

    return routine
