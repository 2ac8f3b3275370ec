# SPDX-License-Identifier: MIT
"""The arrays between a Python host and a driver: strict checks, no copies, nothing converted."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from usersub import ports
from usersub.errors import SceneError

if TYPE_CHECKING:
    from usersub.driver.scene import Scene

_ROLES_WRITTEN = ("out", "add")


def ports_of(face_name: str, kind: str) -> dict[str, ports.Port]:
    """The arrays of a driver of `kind` for the interface called `face_name`, by name."""
    wanted = "coefficient" if kind == "coefficient" else face_name
    return {port.name: port for port in ports.PORTS if wanted in port.drivers}


def sizes(scene: Scene, face_name: str, kind: str) -> dict[str, int]:
    """Values of the shape symbols (`usersub.ports.DIMENSIONS`) for a driver of `kind`."""
    dimension = scene["dimension"]
    contact = scene["contact"] if kind == "explicit" else "node-to-facet"
    edges, analytical = contact == "edge-to-edge", contact == "analytical-rigid"
    facet = 2 if dimension == 2 or edges else 4
    rigid = 0 if face_name == "vfric" else 1
    return {
        "N": scene["points"],
        "D": dimension,
        "F": scene["friction_directions"] or dimension - 1,
        "S": scene["states"],
        "P": scene["fields"],
        "A": 1 if analytical else scene["points"],
        "B": 2 if edges else 1,
        "M": rigid if analytical else facet,
        "X": scene["secondary_nodes"],
        "Y": scene["main_nodes"],
        "Z": scene["nodes"],
        "T": 4 if edges else 1,
    }


def shape_of(port: ports.Port, size: Mapping[str, int]) -> tuple[int, ...]:
    """Shape of `port`'s array, first index fastest."""
    return tuple(size[symbol] if symbol in size else int(symbol) for symbol in port.shape)


def dtype_of(port: ports.Port, precision: str) -> np.dtype:
    """Element type of `port`'s array in a scene of `precision`."""
    if port.kind == "int":
        return np.dtype(np.int32)
    return np.dtype(np.float64 if precision == "double" else np.float32)


class Layout:
    """Names, shapes and element types of a driver's arrays, and the checks of what is bound."""

    def __init__(self, title: str, face_name: str, kind: str, scene: Scene) -> None:
        self.title = title
        self.ports = ports_of(face_name, kind)
        size, precision = sizes(scene, face_name, kind), scene["precision"]
        self.shapes = {name: shape_of(port, size) for name, port in self.ports.items()}
        self.dtypes = {name: dtype_of(port, precision) for name, port in self.ports.items()}

    def port(self, name: str) -> ports.Port:
        """The array called `name`, or SceneError with the nearest name."""
        if name in self.ports:
            return self.ports[name]
        near = difflib.get_close_matches(name, self.ports, n=1, cutoff=0.5)
        hint = f"; did you mean '{near[0]}'?" if near else "."
        raise SceneError(
            f"{self.title} has no array '{name}'{hint} Arrays: {', '.join(self.ports)}"
        )

    def check(self, name: str, array: Any) -> None:
        """Refuses `array` unless it can be bound as `name` without conversion.

        Raises:
            SceneError: no numpy array, or wrong element type, shape, order; not writeable.
        """
        port = self.port(name)
        if port.role == "state":
            raise SceneError(
                f"array '{name}' is kept by the driver and cannot be bound; "
                f"read or set it through driver.state['{name}']"
            )
        if not isinstance(array, np.ndarray):
            raise SceneError(
                f"array '{name}' is {_described(array)}; expected a numpy array of "
                f"{self.dtypes[name]} and shape {self.shapes[name]}"
            )
        self._check_memory(name, array)
        if port.role in _ROLES_WRITTEN and not array.flags.writeable:
            raise SceneError(f"array '{name}' is read-only; expected one that can be written")

    def _check_memory(self, name: str, array: np.ndarray) -> None:
        dtype, shape = self.dtypes[name], self.shapes[name]
        if array.dtype != dtype:
            raise SceneError(
                f"array '{name}' has dtype {array.dtype}; expected {dtype}"
                f"{_dtype_hint(array.dtype, dtype)}"
            )
        if array.shape != shape:
            symbols = ",".join(self.ports[name].shape)
            hint = "; did you mean the transpose, '.T'?" if array.T.shape == shape else ""
            raise SceneError(
                f"array '{name}' has shape {array.shape}; expected {shape} ({symbols}){hint}"
            )
        if not array.flags.f_contiguous:
            how = (
                "make it with order='F' or pass the transpose, '.T', of a C-ordered array of "
                f"shape {shape[::-1]}"
                if array.flags.c_contiguous
                else "make it with numpy.asfortranarray"
            )
            raise SceneError(
                f"array '{name}' is not Fortran-contiguous (first index fastest); {how}"
            )
        if not array.flags.aligned:
            raise SceneError(f"array '{name}' is not aligned to its elements of {dtype}")

    def check_overlaps(self, bound: Mapping[str, np.ndarray]) -> None:
        """Refuses arrays that share memory with one that is written; Fortran forbids that."""
        written = [n for n in bound if self.ports[n].role in _ROLES_WRITTEN]
        for name in written:
            for other, array in bound.items():
                if other != name and np.may_share_memory(bound[name], array):
                    raise SceneError(
                        f"arrays '{name}' and '{other}' share memory; "
                        f"expected '{name}', which is written, to have its own"
                    )


def _described(value: object) -> str:
    return f"of type {type(value).__name__}"


def _dtype_hint(got: np.dtype, expected: np.dtype) -> str:
    if expected.kind == "f" and got.kind == "f" and got.itemsize in (4, 8):
        other = "single" if got.itemsize == 4 else "double"
        return f"; make the scene with precision='{other}' or the array with dtype={expected}"
    return f"; make the array with dtype={expected}"
