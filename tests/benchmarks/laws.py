# SPDX-License-Identifier: MIT
"""One law, exponential decay of the coefficient, as a routine and as loops by hand.

The loops by hand are the limits: the same arithmetic on the same arrays without any driver, with
the scalar `exp` of the C library, with its vector functions, and with a polynomial in the loop.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np

import usersub
from tests.benchmarks import native
from usersub import abi
from usersub.routine import fortran

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

C_EMPTY = """\
#include <usersub/abi.h>
void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {}
"""

_C_LIMIT = """\
#include <math.h>
#include <stdint.h>
#include <string.h>
%s
__attribute__((noinline)) static void limit(double *restrict fCoef, const double *restrict slipRate,
                                            const double *restrict props, long n) {
  const double mu = props[1], more = props[0] - props[1], decay = props[2];
  for (long k = 0; k < n; ++k) fCoef[k] = mu + more * %s(-decay * slipRate[k]);
}
void repeat(double *fCoef, const double *slipRate, const double *props, long n, long times) {
  for (long i = 0; i < times; ++i) {
    limit(fCoef, slipRate, props, n);
    __asm__ volatile("" ::: "memory");
  }
}
"""

_POLYNOMIAL = """\
static inline double polynomial(double x) {
  x = x < -700 ? -700 : x; /* the law's own clamp keeps results normal */
  x = x > 700 ? 700 : x;
  const double whole = 0x1.8p52, k = __builtin_fma(x, 0x1.71547652b82fep+0, whole) - whole;
  const double r = __builtin_fma(k, -0x1.a39ef35793c76p-33, __builtin_fma(k, -0x1.62e42feep-1, x));
  double q = 0x1.1f730349868cep-29;
  q = __builtin_fma(q, r, 0x1.af4de97ca4194p-26);
  q = __builtin_fma(q, r, 0x1.27e4db646b17ep-22);
  q = __builtin_fma(q, r, 0x1.71de0231960ebp-19);
  q = __builtin_fma(q, r, 0x1.a01a01a6d889cp-16);
  q = __builtin_fma(q, r, 0x1.a01a01abe7fe1p-13);
  q = __builtin_fma(q, r, 0x1.6c16c16c162d4p-10);
  q = __builtin_fma(q, r, 0x1.11111111100dcp-7);
  q = __builtin_fma(q, r, 0x1.5555555555556p-5);
  q = __builtin_fma(q, r, 0x1.5555555555557p-3);
  q = __builtin_fma(q, r, 0x1p-1);
  const double bits = k + (whole + 1023);
  int64_t scale;
  memcpy(&scale, &bits, sizeof scale);
  scale <<= 52;
  double two;
  memcpy(&two, &scale, sizeof two);
  return (__builtin_fma(r * r, q, r) + 1) * two;
}
"""

_FORTRAN_LIMIT = """\
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
      subroutine repeat(fCoef, slipRate, props, n, times) bind(c)
      use iso_c_binding
      integer(c_long), value :: n, times
      real(c_double) :: fCoef(n), slipRate(n), props(3)
      integer(c_long) :: i
      interface
        subroutine limit(fCoef, slipRate, props, n) bind(c)
        use iso_c_binding
        integer(c_long), value :: n
        real(c_double) :: fCoef(n), slipRate(n), props(3)
        end subroutine
      end interface
      do i = 1, times
        call limit(fCoef, slipRate, props, n)
      end do
      end
"""

#: Repeats the loop by hand: coefficient (out), slip rate, how often.
Limit = Callable[[np.ndarray, np.ndarray, int], None]


def decay(fCoef, slipRate, props):
    """The law for a block of points."""
    for k in range(fCoef.shape[0]):
        fCoef[k] = props[1] + (props[0] - props[1]) * math.exp(-props[2] * slipRate[k])


python = usersub.vfric_coef(decay)
vectorised = usersub.vfric_coef(vector_math=True)(decay)


def with_libmvec() -> usersub.Routine:
    """The law with the C library's vector functions."""
    return usersub.vfric_coef(vector_math="libmvec")(decay)


def routine(folder: Path, name: str, source: str) -> usersub.Routine:
    """The routine in `source`, compiled by usersub."""
    path = folder / name
    path.write_text(source)
    return usersub.load(path)["vfric_coef"]


def fortran_routine() -> str:
    """The law in fixed form, with the argument list of the table."""
    names = [argument.name for argument in abi.interface("vfric_coef").args]
    lines = [", ".join(names[i : i + 4]) for i in range(0, len(names), 4)]
    return f"""\
      subroutine vfric_coef({f",{chr(10)}     *  ".join(lines)})
      include 'VABA_PARAM.INC'
      dimension fCoef(nBlock), props(nProps), slipRate(nBlock)
      do k = 1, nBlock
        fCoef(k) = props(2) + (props(1) - props(2))
     *    * exp(-props(3) * slipRate(k))
      end do
      end
"""


def limits(folder: Path) -> dict[str, Limit]:
    """Loops by hand, each as a function that repeats it on two arrays."""
    fortran_flags = fortran.flags(False, "double")
    sources = {
        "C": ("scalar.c", _C_LIMIT % ("", "exp"), native.C_FLAGS),
        "libmvec": ("vector.c", _C_LIMIT % ("", "exp"), native.VECTOR_FLAGS),
        "polynomial": (
            "inlined.c",
            _C_LIMIT % (_POLYNOMIAL, "polynomial"),
            (
                "-O3",
                "-march=native",
                "-mprefer-vector-width=512",
                "-ffp-contract=off",
                "-fno-trapping-math",
            ),
        ),
        "Fortran": ("limit.f", _FORTRAN_LIMIT, fortran_flags),
    }
    found = {}
    for name, (file, source, flags) in sources.items():
        found[name] = _limit(native.library(folder, file, source, flags).repeat)
    found["numba"] = _numba_limit()
    return found


def _limit(function) -> Limit:
    import ctypes

    function.argtypes = [ctypes.c_void_p] * 3 + [ctypes.c_long] * 2
    props = np.array(PROPS)

    def call(coefficient: np.ndarray, slip_rate: np.ndarray, times: int) -> None:
        function(
            coefficient.ctypes.data, slip_rate.ctypes.data, props.ctypes.data, slip_rate.size, times
        )

    return call


def _numba_limit() -> Limit:
    """The loop in numba, called directly."""
    import numba

    loop = numba.njit(error_model="numpy")(decay)

    @numba.njit
    def repeat(fCoef, slipRate, props, times):
        for _ in range(times):
            loop(fCoef, slipRate, props)

    props = np.array(PROPS)
    return lambda coefficient, slip_rate, times: repeat(coefficient, slip_rate, props, times)
