# SPDX-License-Identifier: MIT
"""What the three Python drivers share: creation, binding, views, errors."""

from __future__ import annotations

import functools
import sys
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from usersub._prepared import Prepared
from usersub.core import ffi, lib, text
from usersub.driver import handles, status
from usersub.driver.alone import alone
from usersub.driver.arrays import Layout
from usersub.driver.checked import Checked
from usersub.driver.clock import Clock, int32
from usersub.driver.law import LawLike, routine_and_scene
from usersub.driver.observed import Observed, attach, observe
from usersub.driver.plan import Plan, plan_of
from usersub.driver.scene import Scene
from usersub.driver.state import State
from usersub.errors import RoutineError, SceneError
from usersub.routine.routine import Routine

_RAISED = status.VALUES["ROUTINE_RAISED"]
#: What the uncompiled twin of a Python routine may explain: it looks at indices and at inputs.
_EXPLAINED = ("outside", "input written", "left out", "red zone")


class Driver(Checked):
    """A routine in a scene. Made once; afterwards a call is one pointer.

    One thread may use a driver at a time; different drivers are independent, and a call frees the
    GIL.

    Args:
        routine: what a decorator, `usersub.load` or `usersub.from_pointer` gave, or a law
            (`usersub.laws.coulomb(mu=0.3)`, a law function), which brings its properties and its
            number of state variables where the scene gives none.
        scene: what the host's model has.
        reuse: results are views of the driver's own memory, overwritten by the next call, instead
            of fresh copies.

    Raises:
        SceneError: routine and scene do not fit.
    """

    kind: ClassVar[str]
    interfaces: ClassVar[tuple[str, ...]]

    def __init__(self, routine: Routine | LawLike, scene: Scene, *, reuse: bool = False) -> None:
        made, scene = routine_and_scene(self.kind, routine, scene)
        _check_types(type(self), made, scene)
        handles.prepare_process()
        face = made.interface
        self.routine, self.scene, self.reuse = made, scene, reuse
        self._title = f"{face.name.upper()} '{made.name}'"
        self.layout = Layout(self._title, face.name, self.kind, scene)
        self._entry = made.entry(scene["precision"])
        self._c_routine = handles.make_routine(made, self._entry, scene["precision"])
        self._handle = handles.make_driver(self.kind, self._c_routine, scene)
        self._bound: dict[str, np.ndarray] = {}
        self._buffers: dict[str, Any] = {}
        self._views: dict[str, np.ndarray | None] = {}
        self._points = scene["points"]
        self._clock = Clock()
        self._lock = threading.RLock()
        if scene["checked"] and hasattr(self._entry.keep, "exception"):
            self.time_limit = 0.0  # the interpreter cannot be left in the middle
        self.state = State(self)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self._title}, {self.scene['points']} contact points>"

    # Arrays.

    @alone
    def bind(self, **arrays: np.ndarray | None) -> None:
        """Binds numpy arrays by name, without a copy; None unbinds.

        Shapes are those of the manual ("Arrays of the drivers"), Fortran-ordered. An output that is
        bound receives the results.

        Raises:
            SceneError: an array does not fit; nothing has changed.
        """
        fresh = {n: a for n, a in arrays.items() if a is None or self._bound.get(n) is not a}
        if not fresh:
            return
        for name, array in fresh.items():
            if array is None:
                self.layout.port(name)
            else:
                self.layout.check(name, array)
                self._check_warm(name)
        after = {n: a for n, a in {**self._bound, **fresh}.items() if a is not None}
        self.layout.check_overlaps(after)
        for name, array in fresh.items():
            self._bind_one(name, array)

    def _check_warm(self, name: str) -> None:
        """Refuses temperatures of which the scene knows nothing, if the routine reads them."""
        if not name.startswith("temperature") or self.scene["temperatures"]:
            return
        if any(row.used and row.argument.upper().startswith("TEMP") for row in self.plan.rows):
            raise SceneError(
                f"array '{name}' is given, but the scene has no temperatures and so the routine "
                "would read zeros; expected temperatures=1 in the scene"
            )

    def _bind_one(self, name: str, array: np.ndarray | None) -> None:
        if array is None:
            buffer, count = ffi.NULL, 0
        else:
            # The transpose of a Fortran-ordered array is the C-ordered one that cffi accepts.
            buffer, count = ffi.from_buffer(array.T), array.size
        self._check(lib.usub_bind(self._handle, name.encode(), buffer, count))
        self._views.pop(name, None)
        if array is None:
            self._bound.pop(name, None)
            self._buffers.pop(name, None)
        else:
            self._bound[name], self._buffers[name] = array, buffer

    def array(self, name: str) -> np.ndarray:
        """The array called `name`: the host's if bound, else a view of the driver's own memory.

        Raises:
            SceneError: no such array, or nothing is bound and the driver has no memory of its own.
        """
        self.layout.port(name)
        view = self._view(name)
        if view is None:
            raise SceneError(f"array '{name}' is not bound and the driver keeps none in this scene")
        return view

    def keeps(self, name: str) -> bool:
        """Whether there is an array called `name`: the host's or the driver's."""
        return self._view(name) is not None

    def _view(self, name: str) -> np.ndarray | None:
        if name in self._bound:
            return self._bound[name]
        view = self._views.get(name)
        if view is None:  # asked again each time: it may be allocated by what is bound elsewhere
            view = self._views[name] = self._own_memory(name)
        return view

    def _own_memory(self, name: str) -> np.ndarray | None:
        data, count = ffi.new("void **"), ffi.new("size_t *")
        self._check(lib.usub_array(self._handle, name.encode(), data, count))
        shape, dtype = self.layout.shapes[name], self.layout.dtypes[name]
        if count[0] == 0:
            return np.zeros(shape, dtype, order="F") if 0 in shape else None
        address = int(ffi.cast("uintptr_t", data[0]))
        return np.asarray(handles.Memory(self._handle, address, shape, dtype))

    def _result(self, name: str) -> np.ndarray | None:
        """What a call returns for the output `name`: a copy, or a view if `reuse`."""
        view = self._view(name)
        return view if view is None or self.reuse else view.copy(order="F")

    @property
    def points(self) -> int:
        """Contact points that are present now; bound arrays keep their full size."""
        return self._points

    @points.setter
    @alone
    def points(self, count: int) -> None:
        self._check(lib.usub_set_points(self._handle, int32("points", count)))
        self._points = count

    # Plan and state.

    @property
    def plan(self) -> Plan:
        """What is passed to the routine and what is left out, with the arrays bound now."""
        return plan_of(self)

    def _plan_notes(self) -> tuple[str, ...]:
        """What the driver does besides passing arguments, a line each."""
        return ()

    @alone
    def save_state(self) -> bytes:
        """The committed state as bytes (`state.save`)."""
        size = lib.usub_state_size(self._handle)
        buffer = bytearray(size)
        self._check(lib.usub_state_save(self._handle, ffi.from_buffer(buffer), size))
        return bytes(buffer)

    @alone
    def load_state(self, data: bytes) -> None:
        """Takes over saved state (`state.load`)."""
        self._check(lib.usub_state_load(self._handle, ffi.from_buffer(data), len(data)))
        numbers, times = ffi.new("int32_t[2]"), ffi.new("double[3]")
        self._check(lib.usub_get_time(self._handle, numbers, times))
        self._clock.load(numbers, times)

    # Calls.

    def prepare(self) -> Callable[[], int]:
        """A function without arguments that repeats the call with what is bound and set now.

        It is the fastest way to call: one C call with one pointer. It returns the status (0, or 1
        for a cut-back) and raises as the full call does; results are in the bound arrays and in
        `array(name)`.
        """
        if self.routine.after_call is not None:
            call, handle = getattr(lib, self._c_call), self._handle
            return functools.partial(alone(lambda self: self._finish(call(handle))), self)
        function = ffi.addressof(lib, self._c_call)
        addresses = (int(ffi.cast("uintptr_t", pointer)) for pointer in (function, self._handle))
        return Prepared(*addresses, self._check_prepared)

    _c_call: ClassVar[str]  # the function of the C core that a prepared call repeats

    def _finish(self, found: int) -> int:
        """Checks the status of a call of the routine, after its messages were handed on."""
        if self.routine.after_call is not None:
            self.routine.after_call()
        return self._check(found)

    def _set_time(self, step: int, increment: int | None, times: tuple) -> None:
        """Sets the clock; times that are None follow from the last accepted increment."""
        values = self._clock.at(step, increment, *times)
        self._check(lib.usub_set_time(self._handle, *values))
        self._clock.pending = values

    def _check_prepared(self, found: int | None) -> int:
        """As `_check`; None where another thread is in the same prepared call."""
        if found is None:
            raise self._in_use()
        return self._check(found)

    def _enter(self) -> None:
        """Takes the driver for this thread; `_lock.release()` gives it back."""
        if not self._lock.acquire(False):
            raise self._in_use()

    def _in_use(self) -> SceneError:
        return SceneError(
            f"{self._title}: the driver is in use by another thread; expected one thread at a "
            "time, so make a driver for each"
        )

    def _check(self, found: int) -> int:
        """Returns a status that is no failure, raises the exception of one that is."""
        if found >= 0:
            return found
        point = lib.usub_failed_point(self._handle)
        raised = status.exception(found, text(lib.usub_message(self._handle)), point)
        if not isinstance(raised, RoutineError):
            raise raised
        self._where = ""
        seen = observe(self._handle, self.routine) if self.scene["checked"] else Observed()
        cause, where = self._cause() if found == _RAISED or seen.what in _EXPLAINED else (None, "")
        if seen.what != "nothing":
            self._where, where = where, where or seen.where
            attach(raised, replace(seen, where=where))
        raised.where = where
        if cause is not None and not _of_routine(cause):
            raise cause
        words = f": {_words(cause)}" if cause is not None else ""
        place = where or self.routine.origin
        name = f"routine '{self.routine.name}'" + (f", {place}" if place else "")
        raised.args = (f"{raised}{words} ({name})",)
        raise raised from cause

    def _cause(self) -> tuple[BaseException | None, str]:
        """What a Python routine raised and "file:line" of it, by calling its uncompiled twin."""
        keep: Any = self._entry.keep
        if getattr(keep, "exception", None) is None and self.routine.replay is not None:
            entry = self.routine.replay(self.scene["precision"])
            keep = entry.keep
            keep.exception = None
            lib.usub_replay(self._handle, ffi.cast("usub_entry", entry.address))
        cause, where = getattr(keep, "exception", None), getattr(keep, "where", "")
        if cause is not None:
            keep.exception = None
        return cause, where


def _of_routine(cause: BaseException) -> bool:
    """Whether the routine failed; KeyboardInterrupt and the end of a debugger are the user's."""
    debugger = sys.modules.get("bdb")
    return isinstance(cause, Exception) and not (
        debugger is not None and isinstance(cause, debugger.BdbQuit)
    )


def _words(cause: BaseException) -> str:
    name, text = type(cause).__name__, str(cause)
    return f"{name}: {text}" if text else name


def _check_types(driver: type[Driver], routine: Routine, scene: Scene) -> None:
    if not isinstance(routine, Routine):
        raise SceneError(
            f"{driver.__name__} got {type(routine).__name__} as its routine; expected what a "
            "decorator, usersub.load(...)['name'] or usersub.from_pointer gives, or a law"
        )
    if not isinstance(scene, Scene):
        raise SceneError(
            f"{driver.__name__} got {type(scene).__name__} as its scene; expected usersub.Scene"
        )
    face = routine.interface
    if face.name not in driver.interfaces:
        raise SceneError(
            f"{driver.__name__} has no interface {face.name.upper()}; "
            f"it has {', '.join(name.upper() for name in driver.interfaces)}"
        )
    if scene["precision"] not in face.precisions:
        raise SceneError(
            f"scene setting 'precision' = '{scene['precision']}'; "
            f"{face.name.upper()} exists in {' and '.join(face.precisions)} precision only"
        )
