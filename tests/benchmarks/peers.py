# SPDX-License-Identifier: MIT
"""How one would call a VFRIC_COEF routine from Python without this package."""

from __future__ import annotations

import ctypes
from pathlib import Path

import numpy as np

from tests.benchmarks import laws, native
from tests.benchmarks.timing import Repeat
from usersub import abi, paths

_FACE = abi.interface("vfric_coef")


def _fortran_source() -> str:
    """The law as free-form Fortran with types, as f2py wants them."""
    names = [arg.name for arg in _FACE.args]
    kinds = {"real": "double precision", "int": "integer", "char": "character(len=80)"}
    lines = [
        f"  {kinds[a.kind]} :: {a.name}{'(*)' if a.shape and a.kind != 'char' else ''}"
        for a in _FACE.args
    ]
    wanted = ["  intent(inout) :: fCoef", "  integer :: k"]
    listed = ", &\n    ".join(names)
    return "\n".join(
        [f"subroutine vfric_coef({listed})", "  implicit none", *lines, *wanted,
         "  do k = 1, nBlock",
         "    fCoef(k) = props(2) + (props(1) - props(2)) * exp(-props(3) * slipRate(k))",
         "  end do", "end subroutine"]
    )  # fmt: skip


def _values(n: int) -> dict[str, object]:
    """Something for each argument; arrays of `n` points."""
    values: dict[str, object] = {}
    for arg in _FACE.args:
        if arg.kind == "char":
            values[arg.name] = b"NAME".ljust(80)
        elif arg.kind == "int":
            values[arg.name] = np.zeros(1, np.int32)
        else:
            values[arg.name] = np.zeros((n, 3) if "Deriv" in arg.name else n, order="F")
    values["props"] = np.array(laws.PROPS)
    values["nBlock"] = np.full(1, n, np.int32)
    values["nProps"] = np.full(1, 3, np.int32)
    return values


def by_f2py(folder: Path, rate: np.ndarray, points: int) -> Repeat:
    """f2py, `points` points a call."""
    name = f"peer_{points}"
    module = native.f2py(folder, name, _fortran_source())
    function = module.vfric_coef
    values = _values(points)
    values["slipRate"] = rate[:points].copy()
    # numpy scalars would be converted in every call
    arguments = [
        int(v[0]) if isinstance(v, np.ndarray) and v.dtype == np.int32 and not a.shape else v
        for a, v in ((a, values[a.name]) for a in _FACE.args)
    ]

    def repeat(times: int) -> None:
        for _ in range(times):
            function(*arguments)

    repeat(1)
    _check(values["fCoef"], values["slipRate"])
    return repeat


def by_pointer(folder: Path, rate: np.ndarray, how: str) -> Repeat:
    """ctypes or cffi with the published argument list, one point a call, addresses kept."""
    source = laws.C_ROUTINE
    flags = (*native.C_FLAGS, f"-I{paths.include_folder()}")
    values = _values(1)
    values["slipRate"] = rate[:1].copy()
    if how == "ctypes":
        function = native.library(folder, "peer_ctypes.c", source, flags).vfric_coef_
        function.restype = None
        arguments: list = [
            ctypes.c_char_p(v) if isinstance(v, bytes) else v.ctypes.data_as(ctypes.c_void_p)
            for v in (values[a.name] for a in _FACE.args)
        ]
        function.argtypes = [ctypes.c_char_p if isinstance(values[a.name], bytes)
                             else ctypes.c_void_p for a in _FACE.args]  # fmt: skip
    else:
        import cffi

        native.library(folder, "peer_cffi.c", source, flags)
        ffi = cffi.FFI()
        names = {"real": "double *", "int": "int *", "char": "char *"}
        types = [names[a.kind] for a in _FACE.args]
        ffi.cdef(f"void vfric_coef_({', '.join(types)});")
        library = ffi.dlopen(str(folder / "libpeer_cffi.so"))
        function = library.vfric_coef_
        arguments = [
            ffi.new("char[]", v) if isinstance(v, bytes) else ffi.cast(t, v.ctypes.data)
            for t, v in zip(types, (values[a.name] for a in _FACE.args), strict=True)
        ]

    def repeat(times: int, keep: object = (values, function)) -> None:
        for _ in range(times):
            function(*arguments)

    repeat(1)
    _check(values["fCoef"], values["slipRate"])
    return repeat


def by_numpy(rate: np.ndarray) -> Repeat:
    """A numpy expression over all points."""
    static, kinetic, decay = laws.PROPS

    def repeat(times: int) -> None:
        for _ in range(times):
            kinetic + (static - kinetic) * np.exp(-decay * rate)

    return repeat


def _check(found, rate) -> None:
    static, kinetic, decay = laws.PROPS
    expected = kinetic + (static - kinetic) * np.exp(-decay * rate)
    np.testing.assert_allclose(found, expected, rtol=1e-14)
