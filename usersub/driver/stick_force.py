# SPDX-License-Identifier: MIT
"""Stick forces for explicit hosts: what would stop the slip of each contact point."""

from __future__ import annotations

import numpy as np

from usersub.core import ffi, lib
from usersub.errors import SceneError

_SUFFIX = {np.dtype(np.float64): "", np.dtype(np.float32): "_single"}


def stick_force_kinematic(
    velocity: np.ndarray,
    normal: np.ndarray,
    mass: np.ndarray,
    time_increment: float,
    *,
    out: np.ndarray | None = None,
) -> np.ndarray:
    """Force that takes the predicted tangential velocity to zero in the increment: ``m |v| / dt``.

    Args:
        velocity: predicted relative velocity, shape (D, N), Fortran-ordered, float64 or float32.
        normal: unit normals, shape (D, N).
        mass: nodal masses, shape (N,).
        time_increment: above zero.
        out: receives the result if given, shape (N,).

    Raises:
        SceneError: an array does not fit.
    """
    dimension, points = _shape("velocity", velocity)
    function = f"usub_stick_force_kinematic{_suffix('velocity', velocity)}"
    pointers = _inputs(velocity, velocity=velocity, normal=normal)
    pointers += _inputs(velocity, shape=(points,), mass=mass)
    out, target = _output(velocity, points, out)
    found = getattr(lib, function)(points, dimension, *pointers, float(time_increment), target)
    if found < 0:
        raise SceneError(
            f"stick_force_kinematic refused its input: {points} points in {dimension} dimensions, "
            f"time_increment = {time_increment}; expected 2 or 3 dimensions and a positive time"
        )
    return out


def stick_force_penalty(
    previous_force: np.ndarray,
    slip_increment: np.ndarray,
    normal: np.ndarray,
    stiffness: np.ndarray,
    *,
    out: np.ndarray | None = None,
) -> np.ndarray:
    """Elastic trial force of penalty enforcement: ``|F_previous - stiffness ds_t|``.

    Args:
        previous_force: friction force of the previous increment, shape (D, N), Fortran-ordered.
        slip_increment: slip increments, shape (D, N).
        normal: unit normals, shape (D, N).
        stiffness: penalty stiffness, force by length, shape (N,).
        out: receives the result if given, shape (N,).

    Raises:
        SceneError: an array does not fit.
    """
    dimension, points = _shape("previous_force", previous_force)
    function = f"usub_stick_force_penalty{_suffix('previous_force', previous_force)}"
    pointers = _inputs(
        previous_force,
        previous_force=previous_force,
        slip_increment=slip_increment,
        normal=normal,
    )
    pointers += _inputs(previous_force, shape=(points,), stiffness=stiffness)
    out, target = _output(previous_force, points, out)
    if getattr(lib, function)(points, dimension, *pointers, target) < 0:
        raise SceneError(
            f"stick_force_penalty refused its input: {points} points in {dimension} dimensions; "
            "expected 2 or 3 dimensions"
        )
    return out


def _shape(name: str, array: np.ndarray) -> tuple[int, int]:
    if not isinstance(array, np.ndarray) or array.ndim != 2:
        got = array.shape if isinstance(array, np.ndarray) else type(array).__name__
        raise SceneError(f"{name} is {got}; expected a numpy array of shape (dimension, points)")
    return array.shape


def _suffix(name: str, array: np.ndarray) -> str:
    if array.dtype not in _SUFFIX:
        raise SceneError(f"{name} has dtype {array.dtype}; expected float64 or float32")
    return _SUFFIX[array.dtype]


def _pointer(name: str, array: np.ndarray, dtype: np.dtype, shape: tuple[int, ...]):
    if not isinstance(array, np.ndarray) or array.dtype != dtype or array.shape != shape:
        got = (
            f"{array.dtype} of shape {array.shape}"
            if isinstance(array, np.ndarray)
            else type(array).__name__
        )
        raise SceneError(f"{name} is {got}; expected {dtype} of shape {shape}")
    if not array.flags.f_contiguous:
        raise SceneError(f"{name} is not Fortran-contiguous; make it with order='F'")
    return ffi.from_buffer("double[]" if dtype.itemsize == 8 else "float[]", array.T)


def _inputs(like: np.ndarray, shape: tuple[int, ...] | None = None, **arrays: np.ndarray) -> list:
    return [_pointer(n, a, like.dtype, shape or like.shape) for n, a in arrays.items()]


def _output(like: np.ndarray, points: int, out: np.ndarray | None):
    if out is None:
        out = np.empty(points, like.dtype)
    if isinstance(out, np.ndarray) and not out.flags.writeable:
        raise SceneError("out is read-only; expected an array that can be written")
    return out, _pointer("out", out, like.dtype, (points,))
