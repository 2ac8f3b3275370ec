# SPDX-License-Identifier: MIT
"""The CMake package inside the installed Python package builds user code that the drivers load."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import usersub
from usersub import abi, paths

PROJECT = """\
cmake_minimum_required(VERSION 3.20)
project(mine LANGUAGES C Fortran)
find_package(usersub REQUIRED)
usersub_add_routine(mine_c mine.c)
usersub_add_routine(mine_c_single mine.c SINGLE)
usersub_add_routine(mine_fixed mine.f)
usersub_add_routine(mine_fixed_single mine.f SINGLE)
usersub_add_routine(mine_free mine_free.f90)
"""

C_SOURCE = """\
#include <stdlib.h>
#include <usersub/abi.h>
void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  if (props[0] < 0) exit(4);
  for (int k = 0; k < *nBlock; ++k) fCoef[k] = props[0] + slipRate[k];
}
"""

BODY = """\
      include 'vaba_param.inc'
      dimension fCoef(nBlock), props(nProps), slipRate(nBlock)
      if (props(1) .lt. 0) stop 4
      do k = 1, nBlock
        fCoef(k) = props(1) + slipRate(k)
      end do
      end
"""


def head(mark: str, trail: str) -> str:
    """The subroutine statement of VFRIC_COEF, continued by `mark` and `trail`."""
    names = [argument.modern for argument in abi.interface("vfric_coef").args]
    rows = [", ".join(names[i : i + 5]) for i in range(0, len(names), 5)]
    return f"      subroutine vfric_coef({(',' + trail + chr(10) + mark).join(rows)})\n"


@pytest.fixture(scope="session")
def libraries(fortran: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the libraries that CMake made of a user's sources."""
    cmake = shutil.which("cmake")
    if cmake is None:
        pytest.skip("cmake is missing; install it, for example with `apt-get install cmake`")
    folder = tmp_path_factory.mktemp("project")
    (folder / "CMakeLists.txt").write_text(PROJECT)
    (folder / "mine.c").write_text(C_SOURCE)
    (folder / "mine.f").write_text(head("     *  ", "") + BODY)
    (folder / "mine_free.f90").write_text(head("  ", " &") + BODY)
    for command in (
        [cmake, "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={paths.prefix()}"],
        [cmake, "--build", folder / "build"],
    ):
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
    return folder / "build"


@pytest.mark.parametrize(
    ("name", "precision"),
    [
        ("mine_c", "double"),
        ("mine_c_single", "single"),
        ("mine_fixed", "double"),
        ("mine_fixed_single", "single"),
        ("mine_free", "double"),
    ],
)
def test_routine_of_a_cmake_project(libraries, name, precision):
    routine = usersub.load(libraries / f"lib{name}.so", precision=precision)["vfric_coef"]
    scene = usersub.Scene(points=3, props=[0.25], precision=precision)
    rate = np.array([0.5, 1.0, 2.0], np.float64 if precision == "double" else np.float32)
    arrays = {"slip_rate": rate, "pressure": np.ones_like(rate)}
    found = usersub.CoefficientDriver(routine, scene).evaluate(**arrays)
    np.testing.assert_array_equal(found, rate + rate.dtype.type(0.25))

    stopping = usersub.CoefficientDriver(routine, scene.replace(props=[-1.0]))
    with pytest.raises(usersub.RoutineError, match="VFRIC_COEF") as caught:
        stopping.evaluate(**arrays)
    assert caught.value.status == -10
