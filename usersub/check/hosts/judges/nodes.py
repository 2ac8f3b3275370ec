# SPDX-License-Identifier: MIT
"""Node numbers, facets and shape functions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.check.hosts.evidence import Evidence, number, place, tolerance
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import FORCE, SIZES, host_rule


@host_rule(
    "host.nodes",
    "Node numbers lead to nodes: surface positions in VFRIC, node numbers elsewhere.",
    reference="VFRIC: jConSecid holds positions in the surface's own list, 1 to nSecNod; "
    "VFRICTION: jConSecUid holds node numbers; FRIC: NODE, or NOEL and NPT of a contact element",
    hint="Number from one, in the way of the interface.",
    interfaces=("fric", "fric_coef", "vfric", "vfriction"),
    needs=SIZES,
)
def nodes(evidence: Evidence) -> Iterator[str]:
    """Numbers out of range, or twice where each stands once."""
    judge = {"fric": _fric, "fric_coef": _fric_coef, "vfric": _vfric, "vfriction": _vfriction}
    for call in evidence.need_calls():
        found = judge[call.face.name](call)
        if found:
            yield f"{found}; {place(call)}"
            return


def _fric(call: Call) -> str | None:
    element, integration, node = call["NOEL"], call["NPT"], call["NODE"]
    if None in (element, integration, node):
        return None  # host.arrays says so
    if min(element, integration, node) < 0:
        return f"NOEL = {element}, NPT = {integration}, NODE = {node}; expected none below 0"
    if element == 0 and node == 0:
        return "NOEL = 0 and NODE = 0; expected a node, or an element and an integration point"
    return None


def _fric_coef(call: Call) -> str | None:
    flags = call.array("iData") if call.face.key == "fric_coef_2022" else None
    if flags is not None and flags[3] < 0:
        return f"iData(4) = {flags[3]}; expected the number of a node"
    return None


def _vfric(call: Call) -> str | None:
    secondary, main = call.array("jConSecid"), call.array("jConMainid")
    if secondary is not None:
        found = _range("jConSecid", secondary, call["nSecNod"], "nSecNod")
        if found:
            return found
        twice = _twice(secondary)
        if twice is not None:
            return f"jConSecid holds node {twice} twice; a node is one contact point"
    if main is not None and main.size and np.any(main):
        found = _range("jConMainid", main, call["nMainNod"], "nMainNod")
        if found:
            return found
    for name in ("jSecUid", "jMainUid"):
        numbers = call.array(name)
        if numbers is None or not np.any(numbers):
            continue
        if numbers.min() < 1:
            return f"{name} holds {numbers.min()}; expected node numbers from one"
        twice = _twice(numbers)
        if twice is not None:
            return f"{name} holds node {twice} twice; expected every node of the surface once"
    return None


def _vfriction(call: Call) -> str | None:
    for name in ("jConSecUid", "jConMainUid"):
        numbers = call.array(name)
        if numbers is None or not numbers.size or not np.any(numbers):
            continue
        if numbers.min() < 1:
            return f"{name} holds {numbers.min()}; expected node numbers from one"
    return None


def _range(name: str, numbers: np.ndarray, limit: int | None, of: str) -> str | None:
    bad = (numbers < 1) | (numbers > (limit or 0))
    if not bad.any():
        return None
    value = numbers[bad].reshape(-1)[0]
    return f"{name} holds {value}; expected 1 to {of} = {limit}"


def _twice(numbers: np.ndarray) -> int | None:
    values, times = np.unique(numbers, return_counts=True)
    return int(values[times > 1][0]) if (times > 1).any() else None


@host_rule(
    "host.shapes",
    "Shape functions of a contact point sum to one.",
    reference="shape functions are a partition of unity; that the argument holds them is read from "
    "its name and dimensions (assumed)",
    hint="Store the shape functions of one contact point after the other, first index the node.",
    interfaces=FORCE,
    needs=SIZES,
)
def shapes(evidence: Evidence) -> Iterator[str]:
    """Sums over the nodes of a facet or edge."""
    seen = False
    for call in evidence.need_calls():
        names = ("shape",) if call.face.name == "vfric" else ("shapeSec", "shapeMain")
        for name in names:
            values = call.array(name)
            if values is None or not values.size or not np.any(values):
                continue
            seen = True
            sums = values.astype(float).sum(axis=0)
            bad = np.abs(sums - 1) > max(1e-6, tolerance(call))
            if bad.any():
                k = int(np.flatnonzero(bad)[0])
                yield (
                    f"{name} of contact point {k + 1} sums to {number(float(sums[k]))}; expected "
                    f"1; {place(call)}"
                )
                return
    if not seen:
        evidence.say("shape functions are all zero, or there are none")
