# SPDX-License-Identifier: MIT
"""The five argument lists once more, written from the published sources and not from `usersub.abi`.

A row is: name, kind (R real, I integer, C text of 80), dimensions with the first index fastest.
"""

from __future__ import annotations

import ctypes

import numpy as np

FRIC = """
LM I, TAU R NFDIR, DDTDDG R NFDIR NFDIR, DDTDDP R NFDIR, DSLIP R NFDIR, SED R, SFD R,
DDTDDT R NFDIR 2, PNEWDT R, STATEV R NSTATV, DGAM R NFDIR, TAULM R NFDIR, PRESS R, DPRESS R,
DDPDDH R, SLIP R NFDIR, KSTEP I, KINC I, TIME R 2, DTIME R, NOEL I, CINAME C, SECNAME C,
MAINNAME C, NPT I, NODE I, NPATCH I, COORDS R MCRD, RCOORD R MCRD, DROT R 2 2, TEMP R 2,
PREDEF R 2 NPRED, NFDIR I, MCRD I, NPRED I, NSTATV I, CHRLNGTH R, PROPS R NPROPS, NPROPS I
"""

LEGACY = """
fCoef R nBlock, fCoefDeriv R nBlock 3, nBlock I, nProps I, nTemp I, nFields I, jFlags I 2,
rData R 3, surfInt C, surfSec C, surfMain C, props R nProps, slipRate R nBlock,
pressure R nBlock, tempAvg R nBlock, fieldAvg R nBlock nFields
"""

MODERN = """
fCoef R nBlock 2, fCoefDeriv R nBlock 20 2, nBlock I, nProps I, nTemp I, nFields I, iData I 6,
rData R 7+states, surfInt C, surfSec C, surfMain C, props R nProps, slipData R nBlock 6,
pressure R nBlock, tempAvg R nBlock, fieldAvg R nBlock nFields
"""

VFRIC = """
fTangential R nFricDir nContact, statev R nStateVar nSecNod, kStep I, kInc I, nContact I,
nFacNod I, nSecNod I, nMainNod I, nFricDir I, nDir I, nStateVar I, nProps I, nTemp I, nPred I,
numDefTfv I, jSecUid I nSecNod, jMainUid I nMainNod, jConSecid I nContact,
jConMainid I nFacNod nContact, timStep R, timGlb R, dTimCur R, surfInt C, surfSec C, surfMain C,
lContType I, dSlipFric R nDir nContact, fStickForce R nContact, fTangPrev R nDir nContact,
fNormal R nContact, frictionWork R, shape R nFacNod nContact, coordSec R nDir nSecNod,
coordMain R nDir nMainNod, dirCosSl R nDir nContact, dircosN R nDir nContact, props R nProps,
areaSec R nSecNod, tempSec R nContact, preDefSec R nContact nPred, tempMain R numDefTfv,
preDefMain R numDefTfv nPred
"""

VFRICTION = """
fTangential R nFricDir nBlock, state R nStates nNodState nBlock, nBlock I, nBlockAnal I,
nBlockEdge I, nNodState I, nNodSec I, nNodMain I, nFricDir I, nDir I, nStates I, nProps I,
nTemp I, nFields I, jFlags I 3, rData R 4, surfInt C, surfSec C, surfMain C,
jConSecUid I nNodSec nBlock, jConMainUid I nNodMain nBlockAnal, props R nProps,
dSlipFric R nDir nBlock, fStickForce R nBlock, fTangPrev R nDir nBlock, fNormal R nBlock,
areaCont R nBlock, dircosN R nDir nBlock, dircosSl R nDir nBlock, shapeSec R nNodSec nBlockEdge,
shapeMain R nNodMain nBlockAnal, coordSec R nDir nNodSec nBlock,
coordMain R nDir nNodMain nBlockAnal, velSec R nDir nNodSec nBlock,
velMain R nDir nNodMain nBlockAnal, tempSec R nBlock, tempMain R nBlockAnal,
fieldSec R nFields nBlock, fieldMain R nFields nBlockAnal
"""

_LISTS = {"fric": FRIC, "vfric": VFRIC, "vfriction": VFRICTION, "vfric_coef": LEGACY}


def rows(interface: str, generation: str = "2022") -> list[tuple[str, str, tuple[str, ...]]]:
    """Name, kind, dimensions of every argument, in the published order."""
    if interface == "fric_coef":
        text = LEGACY if generation == "legacy" else MODERN
    else:
        text = _LISTS[interface]
    words = [entry.split() for entry in text.replace("\n", " ").split(",")]
    return [(name, kind, tuple(shape)) for name, kind, *shape in words]


def decode(interface: str, generation: str, precision: str, argv) -> dict[str, object]:
    """Copies of all arguments behind the addresses `argv`, in the published shapes."""
    table = rows(interface, generation)
    real = ctypes.c_double if precision == "double" else ctypes.c_float
    numbers = {
        name: ctypes.c_int32.from_address(argv[i]).value
        for i, (name, kind, shape) in enumerate(table)
        if kind == "I" and not shape
    }
    if generation == "2022" and interface == "fric_coef":
        numbers["7+states"] = 7 + (ctypes.c_int32 * 6).from_address(argv[6])[4]
    found: dict[str, object] = {}
    for i, (name, kind, shape) in enumerate(table):
        if kind == "C":
            found[name] = ctypes.string_at(argv[i], 80)
            continue
        extents = tuple(numbers[s] if s in numbers else int(s) for s in shape)
        item = real if kind == "R" else ctypes.c_int32
        flat = np.array((item * int(np.prod(extents, dtype=int))).from_address(argv[i]))
        found[name] = flat.reshape(extents, order="F") if shape else flat[0]
    return found


def writable(interface: str, generation: str, precision: str, argv, name: str):
    """A view of argument `name`, for a probe that answers."""
    table = rows(interface, generation)
    position = [row[0] for row in table].index(name)
    value = decode(interface, generation, precision, argv)[name]
    kind = table[position][1]
    real = ctypes.c_double if precision == "double" else ctypes.c_float
    item = real if kind == "R" else ctypes.c_int32
    extents = np.shape(value) or (1,)
    flat = np.frombuffer((item * int(np.prod(extents))).from_address(argv[position]), item)
    return flat.reshape(extents, order="F")
