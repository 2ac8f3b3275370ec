# SPDX-License-Identifier: MIT
"""Memory and first values of the arguments of a raw call."""

from __future__ import annotations

import mmap
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub import abi
from usersub.emit.numba_adapter import shape_terms

if TYPE_CHECKING:
    from usersub.check.probing.raw import RawCall

_ALIGNED = 64

#: PNEWDT on entry, and how much more than the load the stick force is.
_LARGE, _STICKY = 1e36, 100.0


def allocated(face: abi.Interface, real: np.dtype, counts: dict[str, int]) -> list[np.ndarray]:
    """Zeros (blanks in names) for all arguments, in memory that child processes share."""
    shapes: list[tuple[int, ...]] = []
    kinds: list[np.dtype] = []
    for argument in face.args:
        if argument.kind == "char":
            shapes.append((abi.NAME_LENGTH,))
            kinds.append(np.dtype(np.uint8))
            continue
        dimensions = shape_terms(face, argument)
        shapes.append(tuple(sum(_size(face, t, counts) for t in terms) for terms in dimensions))
        kinds.append(real if argument.kind == "real" else np.dtype(np.int32))
    sizes = [
        -(-(int(np.prod(s)) * k.itemsize + 1) // _ALIGNED) * _ALIGNED
        for s, k in zip(shapes, kinds, strict=True)
    ]
    memory = mmap.mmap(-1, sum(sizes))
    starts = np.cumsum([0, *sizes[:-1]])
    made = [
        np.ndarray(s, k, memory, int(at), order="F")
        for s, k, at in zip(shapes, kinds, starts, strict=True)
    ]
    for argument, value in zip(face.args, made, strict=True):
        if argument.kind == "char":
            value[:] = ord(" ")
        elif argument.name.lower() in counts and not argument.shape:
            value[...] = counts[argument.name.lower()]
    return made


def _size(face: abi.Interface, term: int | tuple[int, int], counts: dict[str, int]) -> int:
    return term if isinstance(term, int) else counts[face.args[term[0]].name.lower()]


def fill(call: RawCall) -> None:
    """Sets sensible values: a first increment with one length of slip in direction 1 under the load
    of the subject's scales, with a stick force far above friction."""
    made = {**_of_all(call), **_standard(call), **_explicit(call)}
    for argument in call.face.args:
        name, value = argument.name.lower(), call[argument.name]
        if name in made and value.size:
            content = np.asarray(made[name], dtype=float)
            # Directions and lists that are longer here than in this interface.
            if content.ndim and value.ndim and content.shape[0] > value.shape[0] > 0:
                content = content[: value.shape[0]]
            value[...] = content
        elif name.startswith("shape") and value.size:
            value[...] = 1.0 / value.shape[0]
        elif name.startswith(("jslv", "jmst", "jcon")):
            value[...] = np.arange(1, value.size + 1).reshape(value.shape, order="F")


def _of_all(call: RawCall) -> dict[str, Any]:
    scales, states = call.subject.scales, call.subject.states
    dt, name = scales.dt, call.face.key
    times = (dt, dt, dt)
    data = {
        "vfriction": (*times, 0.0),
        "fric_coef_2022": (*times, 1.0, 0.0, 0.0, 1.0, *(0.0,) * states),
    }
    rdata = data.get(name, times)
    return {"kstep": 1, "kinc": 1, "jflags": (1, 1, 0), "rdata": rdata, "props": call.subject.props}


def _standard(call: RawCall) -> dict[str, Any]:
    scales, n = call.subject.scales, call.points
    fields = _fields(call)
    slip, dt, rate = scales.slip, scales.dt, scales.slip / scales.dt
    return {
        "dtime": dt, "time": (dt, dt), "pnewdt": _LARGE, "dgam": (slip, 0.0), "press": scales.load,
        "node": 1, "chrlngth": 1.0, "drot": np.eye(2), "coords": (0.5, 0.25, 0.125),
        "temp": (scales.temperature,) * 2, "predef": (fields,) * 2,
        "idata": (1, 1, 1, 1, call.subject.states, call.dimension - 1), "sliprate": rate,
        "slipdata": ((rate, rate, 0.0, slip, slip, 0.0),) * n, "pressure": scales.load,
        "tempavg": scales.temperature, "fieldavg": (fields,) * n,
    }  # fmt: skip


def _explicit(call: RawCall) -> dict[str, Any]:
    scales, n = call.subject.scales, call.points
    fields = _fields(call)
    slip, dt, temperature = scales.slip, scales.dt, scales.temperature
    along, normal = np.eye(call.dimension)[[0, -1]].reshape(2, -1, 1)
    column = np.reshape(fields, (-1, 1))
    return {
        "timstep": dt, "timglb": dt, "dtimcur": dt, "dslipfric": slip * along,
        "fstickforce": _STICKY * scales.load, "fnormal": scales.load, "dircossl": along,
        "dircosn": normal, "areaslv": 1.0, "areacont": 1.0, "tempslv": temperature,
        "tempmst": temperature, "predefslv": (fields,) * n, "predefmst": (fields,),
        "fieldslv": column, "fieldmst": column,
    }  # fmt: skip


def _fields(call: RawCall) -> tuple[float, ...]:
    given = call.subject.scales.fields[: call.subject.fields]
    return (*given, *(0.0,) * (call.subject.fields - len(given)))
