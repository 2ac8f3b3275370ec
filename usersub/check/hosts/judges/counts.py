# SPDX-License-Identifier: MIT
"""Numbers that give sizes."""

from __future__ import annotations

from collections.abc import Iterator

from usersub.check.hosts.evidence import Evidence, place
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import SIZES, host_rule

_FLAG = (0, 1)
#: Count -> what it may be; None for "0 or more".
_ALLOWED: dict[str, dict[str, tuple[int, ...] | None]] = {
    "fric": {
        "NFDIR": (1, 2), "MCRD": (2, 3), "NPRED": None, "NSTATV": None, "NPROPS": None,
    },
    "fric_coef": {"nBlock": None, "nProps": None, "nTemp": _FLAG, "nFields": None},
    "vfric": {
        "nContact": None, "nFacNod": None, "nSecNod": None, "nMainNod": None,
        "nFricDir": (1, 2), "nDir": (2, 3), "nStateVar": None, "nProps": None, "nTemp": _FLAG,
        "nPred": None, "numDefTfv": None,
    },
    "vfriction": {
        "nBlock": None, "nBlockAnal": None, "nBlockEdge": None, "nNodState": (1, 4),
        "nNodSec": (1, 2), "nNodMain": (1, 2, 4), "nFricDir": (2,), "nDir": (3,),
        "nStates": None, "nProps": None, "nTemp": _FLAG, "nFields": None,
    },
    "vfric_coef": {"nBlock": None, "nProps": None, "nTemp": _FLAG, "nFields": None},
}  # fmt: skip
#: What belongs to the interaction and stays.
_CONSTANT = {
    "fric": ("NFDIR", "MCRD", "NPRED", "NSTATV", "NPROPS"),
    "fric_coef": ("nProps", "nTemp", "nFields"),
    "vfric": ("nFricDir", "nDir", "nStateVar", "nProps", "nTemp", "nPred"),
    "vfriction": ("nFricDir", "nDir", "nStates", "nProps", "nTemp", "nFields"),
    "vfric_coef": ("nProps", "nTemp", "nFields"),
}


@host_rule(
    "host.counts",
    "The numbers that give sizes are those of the interface and agree with one another.",
    reference="manual pages of the interfaces: declarations of the arguments",
    hint="Pass the address of a 4-byte integer that holds this count.",
)
def counts(evidence: Evidence) -> Iterator[str]:
    """Each count by itself, then against the others, then over the run."""
    first: dict = {}
    for call in evidence.need_calls():
        found = _alone(call) or _together(call)
        if found:
            yield f"{found}; {place(call)}"
            return
        key = (call.process, call.scenario, call.names)
        begun = first.setdefault(key, call)
        for name in _CONSTANT[call.face.name]:
            if call[name] != begun[name]:
                yield (
                    f"{name} = {call[name]}, but {begun[name]} in {place(begun)}; expected one "
                    f"number for an interaction; {place(call)}"
                )
                return


def _alone(call: Call) -> str | None:
    for name, allowed in _ALLOWED[call.face.name].items():
        value = call[name]
        if value is None:
            return f"{name} cannot be read; expected the address of an integer"
        if allowed is None and value < 0:
            return f"{name} = {value}; expected 0 or more"
        if allowed is not None and value not in allowed:
            return f"{name} = {value}; expected {' or '.join(map(str, allowed))}"
    return None


def _together(call: Call) -> str | None:
    name = call.face.name
    if name == "fric" and call["MCRD"] == 3 and call["NFDIR"] != 2:
        return f"NFDIR = {call['NFDIR']} with MCRD = 3; expected 2 in three dimensions"
    if name == "vfric":
        return _vfric(call)
    if name == "vfriction":
        return _vfriction(call)
    if call.face.key == "fric_coef_2022":
        directions = call.array("iData")
        if directions is not None and directions[5] not in (1, 2):
            return f"iData(6) = {directions[5]}; expected 1 or 2 friction directions"
    return None


def _vfric(call: Call) -> str | None:
    points, nodes = call["nContact"], call["nSecNod"]
    if call["nFricDir"] != call["nDir"] - 1:
        return f"nFricDir = {call['nFricDir']} with nDir = {call['nDir']}; expected nDir - 1"
    if points > nodes:
        return (
            f"nContact = {points} with nSecNod = {nodes}; expected at most as many contact points "
            "as the secondary surface has nodes"
        )
    if call["numDefTfv"] not in (1, points):
        return f"numDefTfv = {call['numDefTfv']}; expected nContact = {points}, or 1"
    if call["nFacNod"] not in (0, 1, 2, 3, 4):
        return f"nFacNod = {call['nFacNod']}; expected 0 to 4 nodes of a main facet"
    return None


def _vfriction(call: Call) -> str | None:
    points = call["nBlock"]
    for name in ("nBlockAnal", "nBlockEdge"):
        if call[name] not in (1, points):
            return f"{name} = {call[name]} with nBlock = {points}; expected nBlock or 1"
    edges = call["nNodSec"] == 2
    if (call["nNodState"] == 4) != edges:
        return (
            f"nNodState = {call['nNodState']} with nNodSec = {call['nNodSec']}; expected 1 with 1 "
            "(nodes) or 4 with 2 (edges)"
        )
    if points > 1 and (call["nBlockEdge"] == points) != edges:
        expected = points if edges else 1
        return (
            f"nBlockEdge = {call['nBlockEdge']} with nNodSec = {call['nNodSec']}; "
            f"expected {expected}"
        )
    if points > 1 and call["nBlockAnal"] == 1 and call["nNodMain"] != 1:
        return (
            f"nBlockAnal = 1 with nBlock = {points} and nNodMain = {call['nNodMain']}; an "
            "analytical rigid surface has one node"
        )
    return None


@host_rule(
    "host.props",
    "The properties of an interaction are the same numbers in every call.",
    reference="manual pages of the interfaces: properties are given once, as data of the model",
    hint="Pass the same array of properties in every call, and do not let it be overwritten.",
    needs=SIZES,
)
def props(evidence: Evidence) -> Iterator[str]:
    """Properties that change."""
    first: dict = {}
    for call in evidence.need_calls():
        name = "PROPS" if call.face.key == "fric" else "props"
        now = bytes(call.argument(name).entry)
        key = (call.process, call.scenario, call.face.key, call.names)
        begun = first.setdefault(key, (call, now))
        if now != begun[1]:
            yield f"{name} in {place(call)} differs from {name} in {place(begun[0])}"
            return
