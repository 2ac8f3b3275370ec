# SPDX-License-Identifier: MIT
"""Bristle laws: a traction vector from the motion of the increment, with vectors as state.

Behind FRIC the vectors are kept in the local directions and turned by DROT; behind VFRIC and
VFRICTION, whose local directions follow the slip, in global components. What of a vector points
along the normal is dropped.
"""

from __future__ import annotations

from collections.abc import Callable

from numpy import empty, zeros

from usersub.lift.kernels import Parts, clear, mean_at, mean_fields

#: A motion below has no direction that can be divided by: the point is at rest.
LEAST_MOTION = 1e-280


def to_local(state, vectors, t, n, i):
    """Vectors of a column of state variables in the local directions of point i."""
    d = t.shape[0]
    for m in range(vectors.shape[0]):
        first, second = 0.0, 0.0
        for j in range(d):
            first += state[m * d + j] * t[j, i]
        if d == 3:
            for j in range(3):
                second += state[m * 3 + j] * across(t, n, i, j)
        vectors[m, 0] = first
        vectors[m, 1] = second


def to_global(vectors, state, t, n, i):
    """Writes vectors in local directions to a column of state variables, in global components."""
    d = t.shape[0]
    for m in range(vectors.shape[0]):
        for j in range(d):
            component = vectors[m, 0] * t[j, i]
            if d == 3:
                component += vectors[m, 1] * across(t, n, i, j)
            state[m * d + j] = component


def across(t, n, i, j):
    """Component j of the second local direction, n x t."""
    a, b = (j + 1) % 3, (j + 2) % 3
    return n[a, i] * t[b, i] - n[b, i] * t[a, i]


def vfric(parts: Parts) -> Callable:
    """VFRIC of a bristle law."""
    value, needed, scalars, counted = parts.value, parts.needed, parts.scalars, parts.vectors
    few, few_states = parts.too_few("VFRIC"), parts.too_few_states("VFRIC")
    law = parts.law
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(fTangential, statev, dSlipFric, dTimCur, fNormal, areaSec, jConSecid, dirCosSl,
                dircosN, tempSec, tempMain, preDefSec, preDefMain, nTemp, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(few)
        d = dirCosSl.shape[0]
        vectors = empty((counted(props), 2), props.dtype)
        head = vectors.shape[0] * d
        count = head + scalars(props)
        if statev.shape[0] < count:
            raise ValueError(few_states)
        field = zeros(preDefSec.shape[1], props.dtype) if fields else props
        for i in range(fNormal.shape[0]):
            if not fNormal[i] > 0:
                continue
            if fields:
                for j in range(field.shape[0]):
                    field[j] = mean_at(preDefSec[:, j], preDefMain[:, j], i)
            place = jConSecid[i] - 1
            to_local(statev[:, place], vectors, dirCosSl, dircosN, i)
            area = areaSec[place]
            found = value(
                dSlipFric[0, i],
                dSlipFric[1, i] if d == 3 else 0.0,
                dTimCur,
                fNormal[i] / area if area > 0 else 0.0,
                mean_at(tempSec, tempMain, i) if temperatures and nTemp > 0 else 0.0,
                field,
                vectors,
                statev[head:count, place],
                props,
            )
            to_global(vectors, statev[:, place], dirCosSl, dircosN, i)
            fTangential[0, i] = -found[0] * area
            if d == 3:
                fTangential[1, i] = -found[1] * area

    return routine


def vfriction(parts: Parts) -> Callable:
    """VFRICTION of a bristle law; an edge keeps the same state with each of its nodes."""
    value, needed, scalars, counted = parts.value, parts.needed, parts.scalars, parts.vectors
    few, few_states = parts.too_few("VFRICTION"), parts.too_few_states("VFRICTION")
    law = parts.law
    times = law.reads("time_increment")
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(fTangential, state, dSlipFric, rData, fNormal, areaCont, dircosN, dircosSl, tempSec,
                tempMain, fieldSec, fieldMain, nTemp, props):  # fmt: skip
        if props.shape[0] < needed(props):
            raise ValueError(few)
        vectors = empty((counted(props), 2), props.dtype)
        head = vectors.shape[0] * 3
        count = head + scalars(props)
        if state.shape[0] < count:
            raise ValueError(few_states)
        field = zeros(fieldSec.shape[0], props.dtype) if fields else props
        for k in range(fNormal.shape[0]):
            if not fNormal[k] > 0:
                continue
            if fields:
                for j in range(field.shape[0]):
                    field[j] = mean_at(fieldSec[j], fieldMain[j], k)
            to_local(state[:, 0, k], vectors, dircosSl, dircosN, k)
            area = areaCont[k]
            found = value(
                dSlipFric[0, k],
                dSlipFric[1, k],
                rData[2] if times else 0.0,
                fNormal[k] / area if area > 0 else 0.0,
                mean_at(tempSec, tempMain, k) if temperatures and nTemp > 0 else 0.0,
                field,
                vectors,
                state[head:count, 0, k],
                props,
            )
            to_global(vectors, state[:, 0, k], dircosSl, dircosN, k)
            fTangential[0, k] = -found[0] * area
            fTangential[1, k] = -found[1] * area
            for node in range(1, state.shape[1]):
                for j in range(count):
                    state[j, node, k] = state[j, 0, k]

    return routine


def fric(parts: Parts) -> Callable:
    """FRIC of a bristle law: all of the motion is slip for the host, and its work is dissipated."""
    evaluate, needed, scalars, counted = parts.evaluate, parts.needed, parts.scalars, parts.vectors
    few, few_states = parts.too_few("FRIC"), parts.too_few_states("FRIC")
    no_time, law = f"{parts.law.name} behind FRIC needs a time increment", parts.law
    times = law.reads("time_increment")
    temperatures, fields = law.reads("temperature"), law.reads("fields")

    def routine(LM, TAU, DDTDDG, DDTDDP, DDTDDT, DSLIP, SED, SFD, STATEV, DGAM, DROT, PRESS, DTIME,
                TEMP, PREDEF, PROPS):  # fmt: skip
        n = DGAM.shape[0]
        if LM[0] == 2:  # open so far: no friction in the increment that closes the point
            clear(STATEV)
            return
        if PROPS.shape[0] < needed(PROPS):
            raise ValueError(few)
        vectors = empty((counted(PROPS), 2))
        head = vectors.shape[0] * n
        if STATEV.shape[0] < head + scalars(PROPS):
            raise ValueError(few_states)
        if times and not DTIME > 0:
            raise ValueError(no_time)
        LM[0] = 0

        for m in range(vectors.shape[0]):
            if n > 1:
                first, second = STATEV[2 * m], STATEV[2 * m + 1]
                vectors[m, 0] = DROT[0, 0] * first + DROT[0, 1] * second
                vectors[m, 1] = DROT[1, 0] * first + DROT[1, 1] * second
            else:
                vectors[m, 0] = STATEV[m]
                vectors[m, 1] = 0.0
        field = mean_fields(PREDEF) if fields else PROPS
        first, second = DGAM[0], DGAM[1] if n > 1 else 0.0
        if not abs(first) + abs(second) > LEAST_MOTION:
            first, second = 0.0, 0.0
        found = evaluate(
            first,
            second,
            DTIME,
            max(PRESS, 0.0),
            0.5 * (TEMP[0] + TEMP[1]) if temperatures else 0.0,
            field,
            vectors,
            STATEV[head : head + scalars(PROPS)],
            PROPS,
        )
        for m in range(vectors.shape[0]):
            for a in range(n):
                STATEV[m * n + a] = vectors[m, a]
        SED[0] = SFD[0] = 0.0
        for a in range(n):
            by = found[3] if a else found[2]
            TAU[a] = found[1] if a else found[0]
            DSLIP[a] = DGAM[a]
            DDTDDG[a, 0] = by[0]
            if n > 1:
                DDTDDG[a, 1] = by[1]
            DDTDDP[a] = by[2] if PRESS >= 0 else 0.0
            DDTDDT[a, 0] = DDTDDT[a, 1] = 0.5 * by[3]
            SFD[0] += TAU[a] * DSLIP[a]

    return routine
