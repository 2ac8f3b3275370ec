# SPDX-License-Identifier: MIT
"""Handles of the C core for a routine, a scene and a driver, freed with their last reference."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from usersub.core import ffi, lib, text
from usersub.driver import status
from usersub.errors import AbiError, Error, SceneError

if TYPE_CHECKING:
    from usersub.driver.scene import Scene
    from usersub.routine.routine import Entry, Routine


class Memory:
    """Memory of the C core for numpy; keeps the driver alive as long as a view lives."""

    def __init__(self, owner: Any, address: int, shape: tuple[int, ...], dtype: np.dtype) -> None:
        strides, step = [], dtype.itemsize
        for extent in shape:
            strides.append(step)
            step *= extent
        self.owner = owner
        self.__array_interface__ = {
            "version": 3,
            "data": (address, False),
            "shape": shape,
            "strides": tuple(strides),
            "typestr": dtype.str,
        }


def prepare_process() -> None:
    """Faults in routines become exceptions, and messages of routines reach their receiver."""
    from usersub.routine import messages

    lib.usub_catch_faults(1)
    messages.connect()


def make_routine(routine: Routine, entry: Entry, precision: str) -> Any:
    """The C core's handle of `routine`, freed with the last reference."""
    face = routine.interface
    made, error = ffi.new("usub_routine **"), ffi.new("usub_error *")
    found = lib.usub_routine_create(
        face.name.encode(),
        face.generation.encode(),
        precision.encode(),
        entry.style,
        ffi.cast("usub_entry", entry.address),
        made,
        error,
    )
    if found < 0:
        raise _made(found, error)
    handle = ffi.gc(made[0], lib.usub_routine_free)
    if routine.uses is not None:
        uses = bytes(routine.uses)
        if lib.usub_routine_set_uses(handle, uses, len(uses)) < 0:
            raise AbiError(
                f"{face.name.upper()} '{routine.name}' says what it uses of {len(uses)} arguments; "
                f"expected {len(face.args)}"
            )
    for flag in ("block_safe", "thread_safe"):
        lib.usub_routine_set_flag(handle, flag.encode(), int(getattr(routine, flag)))
    return handle


def make_driver(kind: str, routine: Any, scene: Scene) -> Any:
    """The C core's driver, freed with the last reference; it keeps the routine's handle alive."""
    c_scene = _make_scene(scene)
    made, error = ffi.new("usub_driver **"), ffi.new("usub_error *")
    found = lib.usub_driver_create(kind.encode(), routine, c_scene, made, error)
    if found < 0:
        raise _made(found, error)

    def free(handle: Any, routine: Any = routine) -> None:
        lib.usub_driver_free(handle)

    return ffi.gc(made[0], free)


def _make_scene(scene: Scene) -> Any:
    made = ffi.new("usub_scene **")
    if lib.usub_scene_create(made) < 0:
        raise Error("no memory for a scene")
    handle = ffi.gc(made[0], lib.usub_scene_free)
    for key, value in scene.items():
        name = key.encode()
        if isinstance(value, str):
            found = lib.usub_scene_set_text(handle, name, value.encode())
        elif isinstance(value, float):
            found = lib.usub_scene_set_real(handle, name, value)
        else:
            found = lib.usub_scene_set_int(handle, name, value)
        if found < 0:
            raise status.exception(found, text(lib.usub_scene_message(handle)))
    if lib.usub_scene_set_props(handle, list(scene.props), len(scene.props)) < 0:
        raise SceneError(text(lib.usub_scene_message(handle)))
    return handle


def _made(found: int, error: Any) -> Error:
    """The exception of a failed creation."""
    return status.exception(found, text(error.message))
