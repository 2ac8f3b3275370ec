# SPDX-License-Identifier: MIT
"""VFRIC and VFRICTION of laws along the slip: a force against it, bounded by the stick force."""

from __future__ import annotations

from collections.abc import Callable

from numpy import zeros

from usersub.lift.kernels import Parts, mean_at, ratio


def _force(parts: Parts) -> Callable:
    """Friction force of one point: the size of what acts against the slip."""
    value, by_area, law = parts.value, parts.by_area, parts.law
    rates, pressures = law.reads("slip_rate"), law.reads("pressure")

    def force(slip, dt, normal, area, stick, temperature, field, state, props):
        rate = ratio(slip, dt) if rates else 0.0
        pressure = ratio(normal, area) if pressures else 0.0
        found = value(rate, pressure, temperature, field, slip, dt, state, props)
        return min(found * (area if by_area else normal), stick)

    return force


def vfric(parts: Parts) -> Callable:
    """VFRIC of a coefficient, a strength or a traction along the slip."""
    force, needed, scalars = _force(parts), parts.needed, parts.scalars
    few, few_states = parts.too_few("VFRIC"), parts.too_few_states("VFRIC")
    law, stateful = parts.law, parts.law.reads("state")
    slips, areas = law.reads("slip_rate", "slip_increment"), parts.by_area or law.reads("pressure")
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(fTangential, statev, dSlipFric, dTimCur, fNormal, fStickForce, areaSec, jConSecid,
                tempSec, tempMain, preDefSec, preDefMain, nTemp, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(few)
        count = scalars(props)
        if statev.shape[0] < count:
            raise ValueError(few_states)
        field = zeros(preDefSec.shape[1], props.dtype) if fields else props
        for i in range(fNormal.shape[0]):
            if not fNormal[i] > 0:
                continue
            if fields:
                for j in range(field.shape[0]):
                    field[j] = mean_at(preDefSec[:, j], preDefMain[:, j], i)
            fTangential[0, i] = -force(
                abs(dSlipFric[0, i]) if slips else 0.0,
                dTimCur,
                fNormal[i],
                areaSec[jConSecid[i] - 1] if areas else 1.0,
                fStickForce[i],
                mean_at(tempSec, tempMain, i) if temperatures and nTemp > 0 else 0.0,
                field,
                statev[:count, jConSecid[i] - 1] if stateful else props,
                props,
            )

    return routine


def vfriction(parts: Parts) -> Callable:
    """VFRICTION of a coefficient, a strength or a traction along the slip; an edge keeps the same
    state variables with each of its nodes."""
    force, needed, scalars = _force(parts), parts.needed, parts.scalars
    few, few_states = parts.too_few("VFRICTION"), parts.too_few_states("VFRICTION")
    law, stateful = parts.law, parts.law.reads("state")
    slips, areas = law.reads("slip_rate", "slip_increment"), parts.by_area or law.reads("pressure")
    times = law.reads("slip_rate", "time_increment")
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(fTangential, state, dSlipFric, rData, fNormal, fStickForce, areaCont, tempSec,
                tempMain, fieldSec, fieldMain, nTemp, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(few)
        count = scalars(props)
        if state.shape[0] < count:
            raise ValueError(few_states)
        field = zeros(fieldSec.shape[0], props.dtype) if fields else props
        for k in range(fNormal.shape[0]):
            if not fNormal[k] > 0:
                continue
            if fields:
                for j in range(field.shape[0]):
                    field[j] = mean_at(fieldSec[j], fieldMain[j], k)
            fTangential[0, k] = -force(
                abs(dSlipFric[0, k]) if slips else 0.0,
                rData[2] if times else 0.0,
                fNormal[k],
                areaCont[k] if areas else 1.0,
                fStickForce[k],
                mean_at(tempSec, tempMain, k) if temperatures and nTemp > 0 else 0.0,
                field,
                state[:count, 0, k] if stateful else props,
                props,
            )
            if stateful:
                for node in range(1, state.shape[1]):
                    for j in range(count):
                        state[j, node, k] = state[j, 0, k]

    return routine
