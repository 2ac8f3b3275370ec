# SPDX-License-Identifier: MIT
"""One call of a routine with arguments of one's own: nothing is checked, nothing is refused.

The drivers refuse NaN and infinity among the inputs and pass what a host would pass. Rules that
need anything else make the arguments themselves:

    call = RawCall(subject, points=3)          # every argument, with sensible values
    call["fNormal"][1] = math.nan              # by any spelling of the interface, any case
    ended = call.run_apart()                   # in a child process; results are in call[...]
    assert ended.how == "returned"
    call["fTangential"], call.point(1)["fTangential"]

Points and nodes correspond one to one: contact point k stands on secondary node k and has main
nodes of its own, so that what belongs to one point is `call.point(k)` in every interface.
"""

from __future__ import annotations

import ctypes
import os
import select
import signal
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub import abi
from usersub.check.clocks import is_late, processor_time
from usersub.check.probing.raw_values import allocated, fill
from usersub.routine.routine import BLOCK, FULL, POINTS, Entry

if TYPE_CHECKING:
    from usersub.check.subject import Subject

#: What an integer argument that counts something is called, by what it counts.
_POINTS = ("nblock", "ncontact", "nslvnod", "nblockanal", "nblockedge", "numdeftfv")
#: What a child process says at the end: the routine came back; it gave a status of failure.
_RETURNED, _FAILED = b"\0", b"\1"
#: Seconds between two looks at a child over its time.
_LOOK = 0.05


@dataclass(frozen=True)
class Ended:
    """How a call ended: `how` is "returned", "failed" (an exception, in the words of `words`),
    "stopped" (XIT, STOP, exit), "crashed" (`words` names the signal) or "time" (it did not return
    within the time limit)."""

    how: str
    words: str = ""


class RawCall:
    """The arguments of one call, as numpy arrays in the shapes of the interface.

    Reals have the precision of the subject; scalars are arrays without dimensions; names are blank.
    The memory is shared with child processes, so that results of `run_apart` are seen here.

    Args:
        subject: routine, properties, sizes, scales.
        points: contact points of the call; 1 for FRIC.
        dimension: coordinate directions, 2 or 3.
        contact: kind of contact (explicit), as in a scene.
        entry: another entry of the same interface and precision instead of the subject's.

    Raises:
        whatever making the entry raises (CompileError, AbiError ...).
    """

    def __init__(
        self,
        subject: Subject,
        points: int = 1,
        dimension: int = 3,
        contact: str = "node-to-facet",
        entry: Entry | None = None,
    ) -> None:
        self.face = subject.interface
        self.subject, self.points, self.dimension = subject, points, dimension
        if entry is None:
            if subject.routine is None:
                raise subject.failure or ValueError("the subject has no routine")
            entry = subject.routine.entry(subject.precision)
        self.entry = entry
        self._real = np.dtype(np.float64 if subject.precision == "double" else np.float32)
        self._values = allocated(self.face, self._real, self._counts(contact))
        fill(self)
        self.start = self.copies()

    def _counts(self, contact: str) -> dict[str, int]:
        """Value of every integer argument that sizes depend on, by its lower-case older name."""
        subject, n, d = self.subject, self.points, self.dimension
        rigid, edge = contact == "analytical-rigid", contact == "edge-to-edge"
        general = self.face.name == "vfriction"
        facet = 1 if rigid and general else 0 if rigid else 2 if edge or d == 2 else 4
        return {
            **dict.fromkeys(_POINTS, n),
            **({"nblockanal": 1, "numdeftfv": 1} if rigid else {}),
            "nblockedge": n if edge else 1,
            "nnodstate": 4 if edge else 1,
            "nnodslv": 2 if edge else 1,
            "nnodmst": facet,
            "nfacnod": facet,
            "nmstnod": max(facet, 1) * n,
            **dict.fromkeys(("nfricdir", "nfdir"), d - 1),
            **dict.fromkeys(("ndir", "mcrd"), d),
            **dict.fromkeys(("nstates", "nstatevar", "nstatv", "idata"), subject.states),
            **dict.fromkeys(("nfields", "npred"), subject.fields),
            "nprops": len(subject.props),
            "ntemp": int(subject.temperatures),
        }

    def __getitem__(self, name: str) -> np.ndarray:
        return self._values[self.face.position(name)]

    def __setitem__(self, name: str, value: Any) -> None:
        self._values[self.face.position(name)][...] = value

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.lower() in self.face.positions

    def copies(self) -> list[np.ndarray]:
        """Copies of all arguments, in their order."""
        return [np.copy(value, order="F") for value in self._values]

    def restore(self, values: list[np.ndarray] | None = None) -> None:
        """Sets all arguments, to what they were made with if nothing is given."""
        for present, value in zip(self._values, values or self.start, strict=True):
            present[...] = value

    def outputs(self) -> dict[str, np.ndarray]:
        """Copies of the arguments that a routine writes, by newer name."""
        return {
            a.modern: np.copy(v, order="F")
            for a, v in zip(self.face.args, self._values, strict=True)
            if a.intent != "read"
        }

    def point(self, index: int) -> dict[str, np.ndarray]:
        """What belongs to one contact point alone, by newer name: views. Numbers that are the same
        for all points are not in it."""
        found = {}
        for argument, value in zip(self.face.args, self._values, strict=True):
            axis = point_axis(argument)
            if self.face.name == "fric" or (axis is not None and value.shape[axis] == self.points):
                where: tuple[Any, ...] = (...,)
                if axis is not None:
                    where = (*(slice(None),) * axis, index, ...)
                found[argument.modern] = value[where]
        return found

    # Calls.

    def run(self) -> int:
        """Calls the routine in this process: a crash is a crash, STOP ends the process.

        Returns:
            0, or the negative status of an entry that turns exceptions into one.
        """
        addresses = [value.ctypes.data for value in self._values]
        if self.entry.style == FULL:
            texts = sum(a.kind == "char" for a in self.face.args)
            types = [ctypes.c_void_p] * len(addresses) + [ctypes.c_size_t] * texts
            lengths = [abi.NAME_LENGTH] * texts
            ctypes.CFUNCTYPE(None, *types)(self.entry.address)(*addresses, *lengths)
            return 0
        pointers = (ctypes.c_void_p * len(addresses))(*addresses)
        if self.entry.style == BLOCK:
            kind = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)
            return kind(self.entry.address)(pointers)
        assert self.entry.style == POINTS
        strides, done = (ctypes.c_int64 * len(addresses))(), ctypes.c_int32(0)
        first = (ctypes.c_int32 * 1)()
        kind = ctypes.CFUNCTYPE(
            ctypes.c_int32, *[ctypes.c_void_p] * 3, ctypes.c_int32, ctypes.c_void_p
        )
        return kind(self.entry.address)(pointers, strides, first, 1, ctypes.byref(done))

    def run_apart(self, seconds: float = 2.0, times: int = 1) -> Ended:
        """Calls the routine in a child process, `times` times with what the call before left.

        What it wrote is in the arguments here, also where it crashed or did not return.
        """
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(reader)
            self._in_child(writer, times)
        os.close(writer)
        try:
            return _ended(child, reader, seconds)
        finally:
            os.close(reader)

    def _in_child(self, writer: int, times: int) -> None:
        """Never returns. The exit code would not tell: a routine may call exit(0)."""
        try:
            from usersub.routine import messages

            messages.connect()
            messages.messages_to(lambda level, text: _tell(writer, text) if level < 0 else None)
            for _ in range(times):
                if self.run() < 0:
                    cause = getattr(self.entry.keep, "exception", None)
                    _tell(writer, f"{type(cause).__name__}: {cause}" if cause else "an exception")
                    os.write(writer, _FAILED)
                    break
            else:
                os.write(writer, _RETURNED)
        finally:
            os._exit(0)


def _tell(writer: int, text: str) -> None:
    os.write(writer, text.encode("utf-8", "replace")[:4000] + b"\n")


def _ended(child: int, reader: int, seconds: float) -> Ended:
    """Waits for the child, ends it after `seconds` of computing; of waiting it may have more, since
    the machine may be busy with other things."""
    start, words, late = time.monotonic(), b"", False
    while not late:
        left = start + seconds - time.monotonic()
        if not select.select([reader], [], [], left if left > 0.0 else _LOOK)[0]:
            waited = time.monotonic() - start
            computed = processor_time(child)
            late = computed is None or is_late(waited, computed, seconds)
            if late:
                os.kill(child, signal.SIGKILL)
        elif not (more := os.read(reader, 1 << 16)):
            break
        else:
            words += more
    _, status = os.waitpid(child, 0)
    how = {_RETURNED: "returned", _FAILED: "failed"}.get(words[-1:], "stopped")
    said = words.rstrip(_RETURNED + _FAILED).decode("utf-8", "replace").strip()
    if late:
        return Ended("time", f"it did not return within {seconds:g} s")
    if os.WIFSIGNALED(status):
        return Ended("crashed", signal.Signals(os.WTERMSIG(status)).name)
    return Ended(how, said)


def point_axis(argument: abi.Arg) -> int | None:
    """Index of the dimension of an argument that counts contact points; None if it has none."""
    for axis, size in enumerate(argument.shape):
        if size.lower() in _POINTS:
            return axis
    return None
