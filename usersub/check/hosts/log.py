# SPDX-License-Identifier: MIT
"""The record that the probe writes: a page of counters and one entry a call."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from usersub import abi
from usersub.errors import Error

#: As in csrc/probe/record.c and csrc/probe/probe.h.
VERSION = 1
HEAD = 4096
_MAGIC = b"USUBPROB"
_ENTRY_MARK = 0x42505355
_COUNTERS = struct.Struct("<8sii24s6q")
_ENTRY = struct.Struct("<IIQqqq3Q8i")
_ARGUMENT = struct.Struct("<Qq4Q2i")

#: Size at which a record ends, whatever the number of calls.
_MOST_BYTES = 256 << 20

#: How the probe found an argument.
FINE, NULL, NOWHERE, SHORT, UNMEASURED = range(5)
#: Why a precision or generation was taken: it was told, seen in the call, or assumed.
TOLD, SEEN, ASSUMED = range(3)


@dataclass(frozen=True)
class Argument:
    """One argument of a call.

    Attributes:
        address: where it lay; 0 for NULL.
        count: elements of the documented size, -1 if a count made no sense.
        size: bytes of the documented size.
        readable: bytes of it that could be read (of at most 16 MiB).
        found: one of FINE, NULL, NOWHERE, SHORT, UNMEASURED.
        refused: whether it could not be written to.
        entry: what it held on entry (at most 4 MiB).
        answer: what the probe left in it, or None if it left it alone.
    """

    address: int
    count: int
    size: int
    readable: int
    found: int
    refused: bool
    entry: memoryview
    answer: memoryview | None


@dataclass(frozen=True, eq=False)
class Call:
    """One recorded call; `call["NFDIR"]` is a number, `call.array("TAU")` an array."""

    face: abi.Interface
    single: bool
    sequence: int
    process: int
    thread: int
    begin: int
    end: int
    lengths: tuple[int, ...]
    precision_basis: int
    generation_basis: int
    arguments: tuple[Argument, ...] = field(repr=False)
    scenario: str = "plain"
    #: Arrays and numbers by name: rules ask for the same ones again and again.
    _arrays: dict[str, Any] = field(default_factory=dict, repr=False)
    _numbers: dict[str, Any] = field(default_factory=dict, repr=False)

    def argument(self, name: str) -> Argument:
        """The argument called `name`, in any spelling."""
        return self.arguments[self.face.positions[name.lower()]]

    def array(self, name: str) -> Any:
        """Values on entry, Fortran-ordered in the documented shape; None if not all of it is
        there."""
        if name not in self._arrays:
            self._arrays[name] = self._values(name, self.argument(name).entry)
        return self._arrays[name]

    def answer(self, name: str) -> Any:
        """Values that the probe left; those on entry where it left them alone."""
        found = self.argument(name)
        return self._values(name, found.entry if found.answer is None else found.answer)

    def __getitem__(self, name: str) -> Any:
        """A scalar on entry, or None if it could not be read."""
        if name not in self._numbers:
            self._numbers[name] = self._scalar(name)
        return self._numbers[name]

    def _scalar(self, name: str) -> float | int | None:
        position = self.face.positions[name.lower()]
        given, about = self.face.args[position], self.arguments[position]
        kind = "<i" if given.kind == "int" else "<f" if self.single else "<d"
        size = struct.calcsize(kind)
        if given.shape or len(about.entry) < size:
            return None
        return struct.unpack(kind, about.entry[:size])[0]

    def text(self, name: str) -> bytes:
        """The bytes of a name."""
        return bytes(self.argument(name).entry)

    @cached_property
    def names(self) -> tuple[bytes, ...]:
        """The three names, which tell interactions apart."""
        return tuple(self.text(a.modern) for a in self.face.args if a.kind == "char")

    def _values(self, name: str, raw: memoryview) -> Any:
        position = self.face.positions[name.lower()]
        given, about = self.face.args[position], self.arguments[position]
        if about.count < 0 or len(raw) < about.size:
            return None
        name_of = "<i4" if given.kind == "int" else "<f4" if self.single else "<f8"
        kind: np.dtype = np.dtype(name_of)
        flat = np.frombuffer(raw[: about.size], dtype=kind)
        shape = self.shape(given)
        return flat.reshape(shape, order="F") if shape is not None else None

    def shape(self, given: abi.Arg) -> tuple[int, ...] | None:
        """Extents of an argument, None if a count could not be read."""
        extents = []
        for dimension in given.shape:
            extent = self._extent(dimension)
            if extent is None or extent < 0:
                return None
            extents.append(extent)
        return tuple(extents)

    def _extent(self, dimension: str) -> int | None:
        if dimension.isdigit():
            return int(dimension)
        base, plus, name = dimension.rpartition("+")
        name, bracket, index = name.partition("(")
        count = self.argument(name)
        at = 4 * (int(index.rstrip(")")) - 1) if bracket else 0
        if len(count.entry) < at + 4:
            return None
        number = int.from_bytes(count.entry[at : at + 4], "little", signed=True)
        return number + (int(base) if plus else 0)


@dataclass(frozen=True)
class Log:
    """What a run of a host left.

    Attributes:
        calls: the recorded calls in the order in which they began.
        total: calls in all, with those that are not recorded.
        latest: clock of the last call in nanoseconds, 0 if there was none.
        abi_hash: argument tables of the probe.
    """

    calls: tuple[Call, ...]
    total: int
    latest: int
    abi_hash: str

    def of(self, interface: str) -> tuple[Call, ...]:
        """The calls of one interface."""
        return tuple(c for c in self.calls if c.face.name == interface)


def create(path: Path, most_calls: int) -> None:
    """Makes an empty record for at most `most_calls` calls."""
    head = _COUNTERS.pack(_MAGIC, VERSION, 0, b"", most_calls, _MOST_BYTES, 0, 0, 0, 0)
    path.write_bytes(head.ljust(HEAD, b"\0"))


def read(path: Path, scenario: str = "plain") -> Log:
    """Reads a record, also one whose host died.

    Raises:
        Error: the file is not a record of this version.
    """
    data = path.read_bytes()
    if len(data) < HEAD or data[:8] != _MAGIC:
        raise Error(f"{path} is not a record of the probe")
    _, version, _, hashed, _, _, total, _, _, latest = _COUNTERS.unpack_from(data)
    if version != VERSION:
        raise Error(f"{path} has version {version} of the probe's record, expected {VERSION}")
    calls = sorted(_entries(memoryview(data), scenario), key=lambda c: c.sequence)
    return Log(tuple(calls), total, latest, hashed.split(b"\0")[0].decode())


def _entries(data: memoryview, scenario: str) -> Iterator[Call]:
    at = HEAD
    while at + _ENTRY.size <= len(data):
        head = _ENTRY.unpack_from(data, at)
        mark, size = head[0], head[2]
        if mark != _ENTRY_MARK or at + size > len(data):
            return  # the host was ended in the middle of an entry
        yield _entry(data, at, head, scenario)
        at += size


def _entry(data: memoryview, at: int, head: tuple[Any, ...], scenario: str) -> Call:
    sequence, begin, end = head[3:6]
    process, thread, key, single, precision, generation, count, _ = head[9:]
    at += _ENTRY.size
    arguments = []
    for _ in range(count):
        address, elements, size, readable, kept, answered, found, refused = _ARGUMENT.unpack_from(
            data, at
        )
        at += _ARGUMENT.size
        entry = data[at : at + kept]
        at += _filled(kept)
        answer = data[at : at + answered] if answered else None
        at += _filled(answered)
        arguments.append(
            Argument(address, elements, size, readable, found, bool(refused), entry, answer)
        )
    return Call(
        abi.INTERFACES[key],
        bool(single),
        sequence,
        process,
        thread,
        begin,
        end,
        tuple(head[6:9]),
        precision,
        generation,
        tuple(arguments),
        scenario,
    )


def _filled(size: int) -> int:
    return (size + 7) // 8 * 8
