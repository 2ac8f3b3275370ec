# SPDX-License-Identifier: MIT
"""Which arguments of an interface a law needs: what it does not read is not fetched."""

from __future__ import annotations

from usersub.lift.description import BRISTLE, COEFFICIENT, TRACTION, Description
from usersub.routine.declaration import Declaration
from usersub.routine.routine import UNUSED

_RATE = ("slip_rate", "slip_increment")
_TIMES = ("slip_increment", "time_increment", "state")
_TEMPERATURE, _FIELDS, _STATE = ("temperature",), ("fields",), ("state",)

#: By interface: arguments that are needed only if the law reads one of these quantities. `stress`,
#: `coefficient`, `elastic` and `motion` stand for a property of its kind.
_NEEDED: dict[str, dict[str, tuple[str, ...]]] = {
    "fric": {
        "TEMP": _TEMPERATURE,
        "PREDEF": _FIELDS,
        "STATEV": ("elastic", "vectors", *_STATE),
        "DROT": ("elastic", "vectors"),
    },
    "fric_coef": {
        "slipRate": _RATE,
        "pressure": ("pressure",),
        "tempAvg": _TEMPERATURE,
        "fieldAvg": _FIELDS,
        "rData": _TIMES,
    },
    "vfric": {
        "statev": ("vectors", *_STATE),
        "dSlipFric": ("motion", *_RATE),
        "areaSec": ("pressure", "stress"),
        "jConSecid": ("pressure", "stress", *_STATE),
        "tempSec": _TEMPERATURE,
        "tempMain": _TEMPERATURE,
        "preDefSec": _FIELDS,
        "preDefMain": _FIELDS,
    },
    "vfriction": {
        "state": ("vectors", *_STATE),
        "dSlipFric": ("motion", *_RATE),
        "rData": ("slip_rate", "time_increment"),
        "areaCont": ("pressure", "stress"),
        "tempSec": _TEMPERATURE,
        "tempMain": _TEMPERATURE,
        "fieldSec": _FIELDS,
        "fieldMain": _FIELDS,
    },
}
_NEEDED["vfric_coef"] = _NEEDED["fric_coef"]
_NEEDED["fric_coef_2022"] = {**_NEEDED["fric_coef"], "slipData": _RATE}


def uses(declaration: Declaration, law: Description) -> tuple[int, ...]:
    """What the routine of a law does with each argument."""
    read = {*law.arguments}
    if law.kind != COEFFICIENT:
        read.add("stress")
    if law.kind not in (TRACTION, BRISTLE):
        read.add("elastic")
    face, found = declaration.interface, list(declaration.uses)
    for name, needed in _NEEDED[face.key].items():
        if name.lower() in face.positions and not read & set(needed):
            found[face.position(name)] = UNUSED
    return tuple(found)
