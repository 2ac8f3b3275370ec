# SPDX-License-Identifier: MIT
"""Memory of the arguments: there, large enough, aligned, apart, finite."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from usersub.check.hosts import log
from usersub.check.hosts.evidence import Evidence, number, place
from usersub.check.hosts.log import Call
from usersub.check.hosts.rule import SIZES, host_rule

_ADDRESS = "the address of an array of the documented size"


@host_rule(
    "host.arrays",
    "Every argument is the address of memory of the documented size, and outputs can be written.",
    reference="manual pages of the interfaces: declarations of the arguments; every argument is "
    "passed by reference, first index fastest",
    hint="Pass the address of an array of that size, also where the host has nothing to tell: a "
    "routine may read it.",
    needs=SIZES,
)
def arrays(evidence: Evidence) -> Iterator[str]:
    """What the probe could not read or write."""
    for call in evidence.need_calls():
        for given, about in zip(call.face.args, call.arguments, strict=True):
            found = _memory(call, given, about) or _alignment(call, given, about)
            if found:
                yield f"{given.modern} {found}; {place(call)}"
                return


def _memory(call: Call, given, about: log.Argument) -> str | None:
    if about.found == log.FINE and not about.refused:
        return None
    size = f"{_shape(call, given)}{about.size} bytes"
    if about.found == log.UNMEASURED:
        return "has a size that depends on a count which makes no sense"
    if about.found == log.NULL:
        return f"is a null pointer; expected {_ADDRESS}, {size}"
    if about.found == log.NOWHERE:
        return f"is the address {about.address:#x}, where nothing can be read; expected {size}"
    if about.found == log.SHORT:
        return f"can be read for {about.readable} bytes; expected {size}"
    return "cannot be written to; expected memory that the routine may change"


def _shape(call: Call, given) -> str:
    extents = call.shape(given)
    if not given.shape or extents is None:
        return ""
    return f"({', '.join(given.shape)}) = ({', '.join(map(str, extents))}), "


def _alignment(call: Call, given, about: log.Argument) -> str | None:
    if given.kind == "char" or about.size == 0:
        return None
    element = 4 if given.kind == "int" or call.single else 8
    if about.address % element:
        return f"is at {about.address:#x}, which is not a multiple of {element}"
    return None


@host_rule(
    "host.apart",
    "What the routine writes shares no memory with another argument.",
    reference="Fortran: an argument that is written must not overlap with another one; compilers "
    "rely on it",
    hint="Give each of the two arguments its own memory.",
    needs=SIZES,
)
def apart(evidence: Evidence) -> Iterator[str]:
    """Overlaps, each pair of arguments once a layout."""
    seen = set()
    for call in evidence.need_calls():
        layout = tuple((a.address, a.size) for a in call.arguments)
        if layout in seen:
            continue
        seen.add(layout)
        found = _overlap(call)
        if found:
            yield f"{found}; {place(call)}"
            return


def _overlap(call: Call) -> str | None:
    places = sorted(
        (
            (about.address, about.address + about.size, given)
            for given, about in zip(call.face.args, call.arguments, strict=True)
            if about.size > 0 and about.address
        ),
        key=lambda place_of: place_of[:2],
    )
    end, holder = 0, None
    written_end, writer = 0, None
    for begin, stop, given in places:
        if begin < written_end and writer is not None:
            return f"{writer.modern} and {given.modern} share memory at {begin:#x}"
        if given.intent != "read":
            if begin < end and holder is not None:
                return f"{holder.modern} and {given.modern} share memory at {begin:#x}"
            if stop > written_end:
                written_end, writer = stop, given
        if stop > end:
            end, holder = stop, given
    return None


#: The manual leaves it open, or the number is a bound that may be absent.
_MAY_BE_INFINITE = frozenset({"fStickForce", "PNEWDT"})


@host_rule(
    "host.finite",
    "What the routine reads are finite numbers.",
    reference="arithmetic: one NaN on entry makes every result a NaN",
    hint="Find where the host computes this number; set what it does not have to zero.",
    needs=SIZES,
)
def finite(evidence: Evidence) -> Iterator[str]:
    """NaN and infinity in arguments that are read."""
    for call in evidence.need_calls():
        for given, about in zip(call.face.args, call.arguments, strict=True):
            if given.kind != "real" or given.intent == "write" or not about.entry:
                continue
            kind = np.dtype("<f4" if call.single else "<f8")
            usable = len(about.entry) // kind.itemsize * kind.itemsize
            values = np.frombuffer(about.entry[:usable], dtype=kind)
            bad = np.isnan(values) if given.modern in _MAY_BE_INFINITE else ~np.isfinite(values)
            if bad.any():
                at = int(np.flatnonzero(bad)[0])
                where = (
                    f"{given.modern}({_index(call, given, at)})" if given.shape else given.modern
                )
                value = number(float(values[at]))
                yield f"{where} = {value}; expected a finite number; {place(call)}"
                return


def _index(call: Call, given, at: int) -> str:
    extents = call.shape(given)
    if not extents or at >= int(np.prod(extents)):
        return str(at + 1)
    return ",".join(str(i + 1) for i in np.unravel_index(at, extents, order="F"))
