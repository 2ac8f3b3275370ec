# SPDX-License-Identifier: MIT
"""What FRIC_COEF and VFRIC_COEF are told of the slip."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.check.hosts.evidence import Evidence, number, place, tolerance
from usersub.check.hosts.history import CUT_BACK, Analysis, Attempt
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import COEFFICIENT, SIZES, host_rule


@host_rule(
    "host.coefficient",
    "Slip rates are not negative, and the slip data of a point agree with one another.",
    reference="FRIC_COEF, manual page: slipRate, slipData (1 magnitude of 2 and 3, 4 equivalent "
    "slip)",
    hint="Pass magnitudes for the slip rate and the equivalent slip, the first index being the "
    "contact point.",
    interfaces=COEFFICIENT,
    needs=SIZES,
)
def coefficient(evidence: Evidence) -> Iterator[str]:
    """Signs and sums; then the equivalent slip over the increments."""
    moved = False
    for call in evidence.need_calls():
        modern = call.face.key == "fric_coef_2022"
        found = _slip_data(call) if modern else _slip_rate(call)
        if found:
            yield f"{found}; {place(call)}"
            return
        rates = call.array("slipData" if modern else "slipRate")
        moved |= rates is not None and bool(np.any(rates))
    for analysis in evidence.analyses:
        found = _equivalent(analysis)
        if found:
            yield found
            return
    if not moved:
        evidence.say("nothing slipped")


def _slip_rate(call: Call) -> str | None:
    rate = call.array("slipRate")
    if rate is None or not np.any(rate < 0):
        return None
    k = int(np.flatnonzero(rate < 0)[0])
    return f"slipRate({k + 1}) = {number(float(rate[k]))}; expected 0 or more"


def _slip_data(call: Call) -> str | None:
    data = call.array("slipData")
    if data is None:
        return None
    for column in (0, 3):
        if np.any(data[:, column] < 0):
            k = int(np.flatnonzero(data[:, column] < 0)[0])
            value = number(float(data[k, column]))
            return f"slipData({k + 1},{column + 1}) = {value}; expected 0 or more"
    sizes = np.hypot(data[:, 1], data[:, 2])
    bad = np.abs(sizes - data[:, 0]) > 10 * tolerance(call) * np.maximum(sizes, data[:, 0])
    if bad.any():
        k = int(np.flatnonzero(bad)[0])
        return (
            f"slipData({k + 1},1) = {number(float(data[k, 0]))}, but slipData({k + 1},2) and "
            f"slipData({k + 1},3) have the magnitude {number(float(sizes[k]))}; expected the same"
        )
    return None


def _equivalent(analysis: Analysis) -> str | None:
    """The equivalent slip of a point never becomes less from one accepted increment to the next."""
    last: dict[int, float] = {}
    base = None
    for attempt in analysis.attempts:
        if attempt.follows == CUT_BACK:
            continue
        if attempt.base is not None and attempt.base is not base:
            base = attempt.base
            last = _smallest(base)
        for call in attempt.calls:
            data, flags = _modern(call)
            if data is None or flags is None or data.shape[0] != 1:
                continue
            before, now = last.get(int(flags[3])), float(data[0, 3])
            if before is not None and now < before * (1 - tolerance(call)):
                return (
                    f"slipData(1,4) = {number(now)} is less than {number(before)} of an increment "
                    f"before; expected the equivalent slip to grow; {place(call)}"
                )
    return None


def _smallest(base: Attempt) -> dict[int, float]:
    """Equivalent slips by node, the least of the calls of an increment: one of them was "
    "accepted."""
    made: dict[int, float] = {}
    for call in base.calls:
        data, flags = _modern(call)
        if data is not None and flags is not None and data.shape[0] == 1:
            node = int(flags[3])
            made[node] = min(float(data[0, 3]), made.get(node, float("inf")))
    return made


def _modern(call: Call):
    if call.face.key != "fric_coef_2022":
        return None, None
    return call.array("slipData"), call.array("iData")
