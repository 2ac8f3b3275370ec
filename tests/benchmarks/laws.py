# SPDX-License-Identifier: MIT
"""One law, exponential decay of the coefficient, as a routine and as a loop by hand, per language.

The loop by hand is the limit: the same arithmetic with the same `exp`, compiled with the same
flags, on the same arrays, without any driver.
"""

from __future__ import annotations

import ctypes
import math
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np

import usersub
from usersub import abi

PROPS = (0.15, 0.05, 0.01)

C_ROUTINE = """\
#include <math.h>
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {
  const double mu = props[1], more = props[0] - props[1], decay = props[2];
  const int n = *nBlock;
  for (int k = 0; k < n; ++k) fCoef[k] = mu + more * exp(-decay * slipRate[k]);
}
"""

C_LIMIT = """\
#include <math.h>
void limit(double *restrict fCoef, const double *restrict slipRate, const double *restrict props,
           long n) {
  const double mu = props[1], more = props[0] - props[1], decay = props[2];
  for (long k = 0; k < n; ++k) fCoef[k] = mu + more * exp(-decay * slipRate[k]);
}
"""

C_REPEAT = """\
void limit(double *, const double *, const double *, long);
void repeat(double *fCoef, const double *slipRate, const double *props, long n, long times) {
  for (long i = 0; i < times; ++i) limit(fCoef, slipRate, props, n);
}
"""

C_EMPTY = """\
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {}
"""

FORTRAN_BODY = """\
      include 'VABA_PARAM.INC'
      dimension fCoef(nBlock), props(nProps), slipRate(nBlock)
      do k = 1, nBlock
        fCoef(k) = props(2) + (props(1) - props(2))
     *    * exp(-props(3) * slipRate(k))
      end do
      end
"""

FORTRAN_LIMIT = """\
      subroutine limit(fCoef, slipRate, props, n) bind(c)
      use iso_c_binding
      integer(c_long), value :: n
      real(c_double) :: fCoef(n), slipRate(n), props(3)
      integer(c_long) :: k
      do k = 1, n
        fCoef(k) = props(2) + (props(1) - props(2))
     *    * exp(-props(3) * slipRate(k))
      end do
      end
"""

#: Repeats the loop by hand: coefficient (out), slip rate, how often.
Limit = Callable[[np.ndarray, np.ndarray, int], None]


@usersub.vfric_coef
def decay(fCoef, slipRate, props):
    for k in range(fCoef.shape[0]):
        fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipRate[k])


def routine(folder: Path, name: str, source: str) -> usersub.Routine:
    """The routine in `source`, compiled by usersub."""
    path = folder / name
    path.write_text(source)
    return usersub.load(path)["vfric_coef"]


def fortran_routine() -> str:
    """The law in fixed form, with the argument list of the table."""
    names = [argument.name for argument in abi.interface("vfric_coef").args]
    lines = [", ".join(names[i : i + 4]) for i in range(0, len(names), 4)]
    return (
        f"      subroutine vfric_coef({(',' + chr(10) + '     *  ').join(lines)})\n{FORTRAN_BODY}"
    )


def limit(folder: Path, name: str, source: str, flags: tuple[str, ...]) -> Limit:
    """The loop by hand in `source` as a function that repeats it on two arrays."""
    path, repeat, library = folder / name, folder / "repeat.c", folder / f"{name}.so"
    path.write_text(source)
    repeat.write_text(C_REPEAT)
    compiler = "gfortran" if path.suffix == ".f" else "gcc"
    subprocess.run(
        [compiler, *flags, "-fPIC", "-shared", "-o", library, path, repeat, "-lm"],
        check=True,
        stderr=subprocess.DEVNULL,  # flags of Fortran are strange to the C file
    )
    function = ctypes.CDLL(str(library)).repeat
    function.argtypes = [ctypes.c_void_p] * 3 + [ctypes.c_long] * 2
    props = np.array(PROPS)

    def call(coefficient: np.ndarray, slip_rate: np.ndarray, times: int) -> None:
        function(
            coefficient.ctypes.data, slip_rate.ctypes.data, props.ctypes.data, slip_rate.size, times
        )

    return call


def python_limit() -> Limit:
    """The loop by hand in numba."""
    import numba

    @numba.njit(error_model="numpy")
    def loop(fCoef, slipRate, props):
        for k in range(fCoef.shape[0]):
            fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipRate[k])

    @numba.njit
    def repeat(fCoef, slipRate, props, times):
        for _ in range(times):
            loop(fCoef, slipRate, props)

    props = np.array(PROPS)
    return lambda coefficient, slip_rate, times: repeat(coefficient, slip_rate, props, times)


def has_fortran() -> bool:
    """Whether gfortran is there."""
    return shutil.which("gfortran") is not None
