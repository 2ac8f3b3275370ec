# SPDX-License-Identifier: MIT
"""How the arguments of an interface are indexed, in words, for those who have to change it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usersub import abi
    from usersub.check.subject import Subject

_COUNTS = "compare the dimension with the counts that the routine is given"
#: Arrays that are taken for others most often, by interface.
_MIXED = {
    "vfric": ("dSlipFric", "fTangential", "statev"),
    "vfriction": ("dSlipFric", "fTangential", "state"),
    "vfric_coef": ("fCoef", "fieldAvg"),
}
#: Arrays of VFRIC with an element for each node of the secondary surface.
_BY_NODE = ("statev", "areaSec", "coordSec", "jSecUid")
_ELEMENT = re.compile(r"(\w+)\(([-\d,]+)\)")


def declared(face: abi.Interface, argument: str) -> str:
    """The argument with its dimensions in the newer spelling, as in dSlipFric(nDir,nContact)."""
    found = face.args[face.position(argument)]
    newer = {a.name: a.modern for a in face.args}
    return f"{found.modern}({','.join(newer.get(s, s) for s in found.shape)})"


def beyond(subject: Subject, argument: str, sentence: str) -> str:
    """What to do about an element outside of an argument."""
    face = subject.interface
    if argument.lower() not in face.positions or not face.args[face.position(argument)].shape:
        return _COUNTS
    hint = f"{_COUNTS}: it is {declared(face, argument)}"
    if face.name == "vfric" and argument in _BY_NODE:
        hint += "; the surface node of contact point i is jConSecid(i)"
        named = _ELEMENT.search(sentence)
        last = int(named[2].rpartition(",")[2]) if named else 0
        if last > 1000:  # nodes of the surfaces are numbered from there on
            hint += f"; {last} is no such node but a global number, as in jSecUid"
    if face.name == "vfric" and argument in ("tempMain", "preDefMain"):
        hint += "; on an analytical rigid surface numDefTfv is 1: index it by min(i,numDefTfv)"
    if face.name == "vfriction" and "nBlockAnal" in declared(face, argument):
        hint += "; on an analytical rigid surface nBlockAnal is 1: index it by min(k,nBlockAnal)"
    return hint


def own_point(subject: Subject, fields: bool = False) -> str:
    """What to do where points depend on each other, and that with more field variables."""
    face = subject.interface
    first = [f for f in ("fieldSec", "preDefSec", "fieldAvg") if f.lower() in face.positions]
    names = (*first, *_MIXED[face.name]) if fields else _MIXED[face.name]
    listed = ", ".join(declared(face, name) for name in dict.fromkeys(names))
    hint = (
        "set every variable anew for each point, and index every array with the right dimensions: "
        f"{listed}"
    )
    if face.name == "vfric":
        hint += ", where statev and areaSec are indexed by the surface node jConSecid(i), not by i"
    return hint
