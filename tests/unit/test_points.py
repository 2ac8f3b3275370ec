# SPDX-License-Identifier: MIT
"""Compiled FRIC routines, called once for a run of points, against calls point by point."""

from __future__ import annotations

import ctypes
import dataclasses
import math
from functools import cache

import numpy as np
import pytest

import usersub
from usersub import abi
from usersub.errors import Error, RoutineError
from usersub.routine.compiled import compiled_entry
from usersub.routine.declaration import declare
from usersub.routine.routine import BLOCK, POINTS, Entry, Routine

COUNT = 150  # two full runs of 64 and a part of one
FEW = {"points": COUNT, "temperatures": 1, "states": 1}
SIZES = {"points": COUNT, "dimension": 3, "fields": 2, "temperatures": 1, "props": [0.3, 0.7]}


@cache
def one_by_one(routine: Routine) -> Routine:
    """The same function behind an entry for one point."""
    entry = compiled_entry(declare("fric", routine.function, None), "double", BLOCK)
    return dataclasses.replace(routine, make_entry=lambda precision: entry)


@usersub.fric
def everything(CHRLNGTH, CINAME, COORDS, DDPDDH, DDTDDG, DDTDDP, DDTDDT, DGAM, DPRESS, DROT, DSLIP,
               DTIME, KINC, KSTEP, LM, NODE, NOEL, NPT, PNEWDT, PREDEF, PRESS, PROPS, RCOORD, SED,
               SFD, SLIP, STATEV, TAU, TAULM, TEMP, TIME):  # fmt: skip
    entry = LM[0] + 10.0 * TAU[0] + 100.0 * DSLIP[1] + SED[0] + SFD[0]
    empty = DDTDDG[1, 0] + DDTDDP[1] + DDTDDT[1, 1]
    told = TAULM[1] + DPRESS + DDPDDH + SLIP[0] + NOEL + NPT + NODE + KSTEP + KINC
    place = COORDS[2] + 3.0 * RCOORD[1] + DROT[1, 0] + TIME[0] + DTIME + CHRLNGTH + len(CINAME)
    warm = TEMP[0] + 5.0 * TEMP[1] + PREDEF[0, 0] + 7.0 * PREDEF[1, 1] + 11.0 * PREDEF[0, 1]
    STATEV[0] += entry + empty + told
    STATEV[1] = place + warm + PROPS[1] * PRESS + PNEWDT[0] * 1e-36
    LM[0] = (NODE + KINC) % 3
    for i in range(2):
        TAU[i] = PROPS[0] * PRESS * DGAM[i] + STATEV[0]
        DSLIP[i] = 0.5 * DGAM[i]
        DDTDDP[i] = DGAM[i] + NODE
        for j in range(2):
            DDTDDG[i, j] = 10.0 * i + j + PRESS
            DDTDDT[i, j] = 10.0 * i - j + PRESS
    SED[0] = STATEV[1]
    SFD[0] = math.sqrt(PRESS)
    PNEWDT[0] = 1.5 + NODE


@usersub.coefficient(props=2, states=1)
def wearing(slip_rate, slip_increment, state, props):
    state[0] += slip_increment
    return props[0] + props[1] * math.exp(-slip_rate - state[0])


def arrays(seed: int) -> dict[str, np.ndarray]:
    """Of `everything`; about every tenth point is open, and some have been so for long."""
    random = np.random.default_rng(seed)
    shapes = {
        "slip_increment": (2, COUNT), "pressure": (COUNT,), "multiplier": (2, COUNT),
        "coord": (3, COUNT), "coord_main": (3, COUNT), "temperature_secondary": (COUNT,),
        "temperature_main": (COUNT,), "field_secondary": (2, COUNT), "field_main": (2, COUNT),
        "rotation": (2, 2, COUNT), "contact_stiffness": (COUNT,),
    }  # fmt: skip
    made = {name: np.asfortranarray(random.normal(size=shape)) for name, shape in shapes.items()}
    made["pressure"] = random.uniform(-0.1, 0.9, COUNT)
    made["pressure"][30:33] = -1.0
    return made


def history(routine: Routine, inputs, **settings) -> list[bytes]:
    """Bits of every answer of two iterations in each of three increments, and of the state."""
    driver = usersub.StandardDriver(routine, usersub.Scene(**{**SIZES, **settings}))
    bits = []
    for increment in range(1, 4):
        driver.begin_increment(0.25)
        for iteration in range(2):
            found = driver.iterate(**inputs(10 * increment + iteration))
            bits += [np.asarray(result).tobytes() for result in found if result is not None]
        driver.commit()
        bits.append(driver.state.save())
    return bits


@pytest.mark.parametrize("tangent", [0, 1])
@pytest.mark.parametrize("block", [0, 1, 7, 100])
@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("pass_everything", [0, 1])
def test_the_same_bits_as_point_by_point(tangent, block, threads, pass_everything):
    wanted = {"states": 2, "tangent": tangent, "temperature_tangent": tangent}
    expected = history(one_by_one(everything), arrays, **wanted)
    found = history(
        everything, arrays, block=block, threads=threads, pass_everything=pass_everything, **wanted
    )
    assert found == expected


def test_a_law_function_gives_the_same_bits():
    settings = {"states": 3, "characteristic_length": 2.0, "fields": 0, "temperatures": 0}

    def inputs(seed: int) -> dict[str, np.ndarray]:
        return {name: arrays(seed)[name] * 0.1 for name in ("slip_increment", "pressure")}

    wearing.fric.entry()  # tells numba of the law
    assert history(wearing.fric, inputs, **settings) == history(
        one_by_one(wearing.fric), inputs, **settings
    )


def test_a_call_lists_the_closed_points_of_a_part_of_a_block():
    calls = []

    @ctypes.CFUNCTYPE(
        ctypes.c_int32, ctypes.POINTER(ctypes.c_void_p), ctypes.POINTER(ctypes.c_int64),
        ctypes.POINTER(ctypes.c_int32), ctypes.c_int32, ctypes.POINTER(ctypes.c_int32),
    )  # fmt: skip
    def entry(argv, stride, points, count, done):
        node = face.position("NODE")
        first = ctypes.c_int32.from_address(argv[node]).value - 1
        calls.append([first + point for point in points[:count]])
        assert stride[node] == 4 and stride[face.position("TAU")] == 16
        assert stride[face.position("PROPS")] == stride[face.position("NFDIR")] == 0
        return 0

    face = abi.interface("fric")
    address = ctypes.cast(entry, ctypes.c_void_p).value
    routine = Routine(face, "pointer", "entry", "", lambda _: Entry(address, POINTS, entry))
    made = usersub.StandardDriver(routine, usersub.Scene(points=COUNT, block=60))
    pressure = np.ones(COUNT)
    open_points = [0, 10, 11, 59, *range(60, 120), 149]
    pressure[open_points] = 0.0
    made.begin_increment(1.0)
    made.iterate(slip_increment=np.ones((2, COUNT), order="F"), pressure=pressure)
    closed = [p for p in range(COUNT) if p not in open_points]
    # no call for the second block, in which all points are open
    assert calls == [[p for p in closed if p < 60], [p for p in closed if p >= 120]]


memset = ctypes.CDLL(None).memset
memset.argtypes = [ctypes.c_size_t, ctypes.c_int, ctypes.c_size_t]
memset.restype = ctypes.c_size_t


@usersub.fric
def failing(LM, TAU, NODE, COORDS, TEMP, PNEWDT, STATEV, PROPS):
    LM[0] = 0
    TAU[0] = COORDS[0] + TEMP[1]
    if NODE - 1 == PROPS[0]:
        raise ValueError("beyond the tests")
    if NODE - 1 == PROPS[1]:
        TAU[1] = math.nan
    if NODE - 1 == PROPS[2]:
        LM[0] = 3
    if NODE - 1 == PROPS[3]:
        PNEWDT[0] = 0.25
    if NODE - 1 == PROPS[4]:
        memset(8, 0, 1)
    if NODE - 1 == PROPS[5]:
        STATEV[0] = math.inf


def inputs_of_failing() -> dict[str, np.ndarray]:
    names = ("slip_increment", "coord", "temperature_secondary", "temperature_main")
    return {"pressure": np.ones(COUNT), **{name: arrays(1)[name] for name in names}}


NEVER = [-1.0] * 6
FAILURES = [
    # what happens at which point, what is not finite at which point, the point that is reported
    ({0: 0}, {}, 0, "ValueError: beyond the tests"),
    ({0: 63}, {}, 63, "ValueError: beyond the tests"),
    ({0: 64}, {}, 64, "ValueError: beyond the tests"),
    ({0: 70}, {}, 70, "ValueError: beyond the tests"),
    ({0: COUNT - 1}, {}, COUNT - 1, "ValueError: beyond the tests"),
    ({0: 9, 1: 5}, {}, 5, "TAU, element 2"),
    ({0: 9, 2: 8}, {}, 8, "LM = 3"),
    ({0: 9, 5: 8}, {}, 8, "state variable 1"),
    ({0: 9, 1: 10, 2: 11}, {}, 9, "ValueError"),
    ({4: 20}, {}, 20, "memory fault"),
    ({4: 20, 2: 19}, {}, 19, "LM = 3"),
    ({4: 20, 2: 21}, {}, 20, "memory fault"),
    ({0: 9}, {"coord": 12}, 9, "ValueError"),
    ({0: 9}, {"coord": 5}, 5, "coord of point 5"),
    ({0: 9}, {"pressure": 12}, 9, "ValueError"),
    ({0: 9}, {"pressure": 5}, 5, "pressure[5]"),
    ({}, {"coord": 40, "temperature_main": 39}, 39, "temperature_main of point 39"),
    ({}, {"slip_increment": 40, "coord": 41}, 40, "slip_increment of point 40"),
]


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize(("at", "bad", "point", "words"), FAILURES)
def test_failures_name_the_same_point(at, bad, point, words, threads):
    props = [float(at.get(i, -1)) for i in range(len(NEVER))]
    messages = []
    for routine in (failing, one_by_one(failing)):
        scene = usersub.Scene(**FEW, props=props, block=100, threads=threads)
        made = usersub.StandardDriver(routine, scene)
        inputs = inputs_of_failing()
        for name, place in bad.items():
            inputs[name][..., place] = math.nan
        made.begin_increment(1.0)
        with pytest.raises(Error) as caught:
            made.iterate(**inputs)
        assert getattr(caught.value, "point", point) == point and words in str(caught.value)
        messages.append(str(caught.value))
        made.cut_back()
    assert messages[0] == messages[1]


def test_an_exception_behind_open_points():
    inputs = inputs_of_failing()
    inputs["pressure"][[2, 3, 8]] = -1.0
    props = [6.0, *NEVER[1:]]
    made = usersub.StandardDriver(failing, usersub.Scene(**FEW, props=props))
    made.begin_increment(1.0)
    with pytest.raises(RoutineError, match="at point 6") as caught:
        made.iterate(**inputs)
    assert isinstance(caught.value.__cause__, ValueError) and caught.value.point == 6
    inputs["pressure"][6] = -1.0  # it is not called for
    made.iterate(**inputs)
    made.commit()


@pytest.mark.parametrize("threads", [1, 3])
def test_one_point_asks_for_a_shorter_increment(threads):
    props = [*NEVER[:3], 77.0, *NEVER[4:]]
    scene = usersub.Scene(**FEW, props=props, block=40, threads=threads)
    made = usersub.StandardDriver(failing, scene)
    made.begin_increment(1.0)
    found = made.iterate(**inputs_of_failing())
    assert found.cut_back and found.pnewdt == 0.25


def test_styles():
    assert everything.entry().style == POINTS
    assert usersub.fric(everything.function, compiled=False).entry().style == BLOCK
    assert wearing.fric.entry().style == POINTS and wearing.vfric.entry().style == BLOCK
    assert wearing.fric_coef.entry().style == BLOCK
