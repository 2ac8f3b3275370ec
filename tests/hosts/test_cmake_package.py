# SPDX-License-Identifier: MIT
"""The CMake package of the C core: what users' projects do with it, and what is refused."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

_ROOT = Path(__file__).resolve().parents[2]

PROJECT = """\
cmake_minimum_required(VERSION 3.20)
project(mine LANGUAGES C CXX Fortran)
set(CMAKE_Fortran_FLAGS "-std=f2008") # the module of usersub is newer
find_package(usersub 0.1 REQUIRED)
add_executable(host host.c)
target_link_libraries(host PRIVATE usersub::usersub)
add_executable(first host.f90)
target_link_libraries(first PRIVATE usersub::fortran)
add_executable(second host.f90)
target_link_libraries(second PRIVATE usersub::fortran)
set(CMAKE_Fortran_FLAGS "")
usersub_add_routine(one one_constants.f90 law.f90 scale.c)
usersub_add_routine(two two_constants.f90 law.f90 scale.c)
usersub_add_routine(with_folder with_folder.f)
target_include_directories(with_folder PRIVATE folder)
usersub_add_routine(throws throws.cpp)
usersub_add_routine(reads reads.f)
"""

# Prints the coefficient at slip rate 2, or what went wrong; what a host catches is printed as such.
HOST = """\
#include <stdio.h>
#include <usersub/usersub.h>
int main(int count, char **arguments) {
  usub_error error = {0, ""};
  usub_routine *routine = NULL;
  usub_scene *scene = NULL;
  usub_driver *driver = NULL;
  double props[] = {0.25}, rate[] = {2.0}, pressure[] = {count > 2 ? -1.0 : 1.0}, mu[] = {0.0};
  usub_routine_open(arguments[1], "vfric_coef", NULL, "double", &routine, &error);
  usub_scene_create(&scene);
  usub_scene_set_props(scene, props, 1);
  usub_driver_create("coefficient", routine, scene, &driver, &error);
  usub_bind(driver, "slip_rate", rate, 1);
  usub_bind(driver, "pressure", pressure, 1);
  usub_bind(driver, "coefficient", mu, 1);
  int32_t status = usub_evaluate(driver);
  printf("%s %g %s%s\\n", usub_status_name(status), mu[0], error.message, usub_message(driver));
  usub_driver_free(driver);
  usub_scene_free(scene);
  usub_routine_free(routine);
  return 0;
}
"""

FORTRAN_HOST = """\
program host
  use usersub
  implicit none
  print '(a)', usub_string(usub_status_name(usub_status_cut_back))
end program
"""

CONSTANTS = """\
module constants
  double precision, parameter :: factor = {factor}
end module
"""

# A line of more than 132 columns, which the Fortran standard does not allow.
LAW = """\
subroutine vfric_coef(fCoef, fCoefDeriv, nBlock, nProps, nTemp, nFields, jFlags, rData, surfInt, \
surfSec, surfMain, props, slipRate, pressure, tempAvg, fieldAvg)
  use constants
  include 'vaba_param.inc'
  dimension fCoef(nBlock), props(nProps), slipRate(nBlock)
  do k = 1, nBlock
    fCoef(k) = props(1) + factor*slipRate(k)
    call scale_by_four(fCoef(k))
  end do
end subroutine
"""

SCALE = "void scale_by_four_(double *x) { *x *= 4; }\n"

WITH_FOLDER = """\
      SUBROUTINE VFRIC_COEF(FCOEF, FCOEFDERIV, NBLOCK, NPROPS, NTEMP,
     1 NFIELDS, JFLAGS, RDATA, SURFINT, SURFSLV, SURFMST, PROPS,
     2 SLIPRATE, PRESSURE, TEMPAVG, FIELDAVG)
      INCLUDE 'VABA_PARAM.INC'
      INCLUDE 'factor.inc'
      DIMENSION FCOEF(NBLOCK), SLIPRATE(NBLOCK)
      DO 10 K = 1, NBLOCK
   10 FCOEF(K) = FACTOR*SLIPRATE(K)
      END
"""

# Reads a file that is not there, where the pressure is negative.
READS = """\
      SUBROUTINE VFRIC_COEF(FCOEF, FCOEFDERIV, NBLOCK, NPROPS, NTEMP,
     1 NFIELDS, JFLAGS, RDATA, SURFINT, SURFSLV, SURFMST, PROPS,
     2 SLIPRATE, PRESSURE, TEMPAVG, FIELDAVG)
      INCLUDE 'VABA_PARAM.INC'
      DIMENSION FCOEF(NBLOCK), SLIPRATE(NBLOCK), PRESSURE(NBLOCK)
      DO 10 K = 1, NBLOCK
        IF (PRESSURE(K) .LT. 0) THEN
          OPEN(15, FILE='/there is/no such file', STATUS='OLD')
        ELSE
          FCOEF(K) = SLIPRATE(K)
        END IF
   10 CONTINUE
      END
"""

THROWS = """\
#include <stdexcept>
#include <string>
#include <usersub/abi.h>
extern "C" void FOR_NAME(vfric_coef, VFRIC_COEF)(USUB_VFRIC_COEF_PARAMETERS) {
  std::string words = "negative pressure";
  for (int i = 0; i < *nBlock; ++i) {
    if (pressure[i] < 0) throw std::runtime_error(words);
    fCoef[i] = props[0];
  }
}
"""


def _run(*command: object, env: dict | None = None) -> subprocess.CompletedProcess:
    words = [str(c) for c in command]
    environment = {**os.environ, **(env or {})}
    return subprocess.run(words, capture_output=True, text=True, timeout=300, env=environment)


def _done(*command: object) -> str:
    done = _run(*command)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="session")
def project(prefix: Path, fortran: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A user's project, built with ninja where there is one: it finds files that are made twice."""
    folder = tmp_path_factory.mktemp("users project")
    (folder / "folder").mkdir()
    for name, text in {
        "CMakeLists.txt": PROJECT,
        "host.c": HOST,
        "host.f90": FORTRAN_HOST,
        "one_constants.f90": CONSTANTS.format(factor="1d0"),
        "two_constants.f90": CONSTANTS.format(factor="2d0"),
        "law.f90": LAW,
        "scale.c": SCALE,
        "with_folder.f": WITH_FOLDER,
        "folder/factor.inc": "      PARAMETER (FACTOR = 3D0)\n",
        "throws.cpp": THROWS,
        "reads.f": READS,
    }.items():
        (folder / name).write_text(text)
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    build = folder / "build"
    _done("cmake", "-S", folder, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", *generator)
    _done("cmake", "--build", build)
    return build


@pytest.mark.parametrize(
    ("library", "answer"),
    # One: 4 (0.25 + 2), two: 4 (0.25 + 2 * 2), with the module of its own; folder: 3 * 2.
    [
        ("one", "OK 9 "),
        ("two", "OK 17 "),
        ("with_folder", "OK 6 "),
        ("throws", "OK 0.25 "),
        ("reads", "OK 2 "),
    ],
)
def test_routines_of_several_files(project, library, answer):
    assert _done(project / "host", project / f"lib{library}.so") == answer + "\n"


@pytest.mark.parametrize("program", ["first", "second"])
def test_two_fortran_programs_share_the_module(project, program):
    assert _done(project / program) == "CUT_BACK\n"


def test_a_cxx_exception_is_a_status_in_a_c_host(project):
    printed = _done(project / "host", project / "libthrows.so", "negative")
    assert printed.startswith("ROUTINE_RAISED 0 VFRIC_COEF: the routine ended with ")
    assert "an exception: negative pressure" in printed


def test_a_cxx_exception_does_not_pass_through_to_a_cxx_host(project, prefix, tmp_path):
    """Neither the host's `catch` nor the end of the process: the same status."""
    source = tmp_path / "host.cpp"
    host = HOST.replace("int32_t status = usub_evaluate(driver);", "int32_t status = 99; CALL")
    call = 'try { status = usub_evaluate(driver); } catch (...) { puts("caught"); }'
    source.write_text(host.replace("CALL", call))
    library = ["-L", prefix / "lib", "-lusersub", f"-Wl,-rpath,{prefix / 'lib'}"]
    _done("c++", source, "-o", tmp_path / "host", "-I", prefix / "include", *library)
    printed = _done(tmp_path / "host", project / "libthrows.so", "negative")
    assert printed.startswith("ROUTINE_RAISED 0 VFRIC_COEF: the routine ended with ")


def test_an_error_of_fortran_input_is_a_status(project, fortran, prefix, tmp_path):
    """Whether the library was built by the function of the package or by others."""
    field = prefix / "include/usersub/field/double"
    source, plain = project.parent / "reads.f", tmp_path / "plain.so"
    _done(fortran, "-shared", "-fPIC", f"-I{field}", source, "-o", plain)
    for library in (project / "libreads.so", plain):
        printed = _done(project / "host", library, "negative")
        assert printed.startswith("ROUTINE_STOPPED 0 VFRIC_COEF: the routine ended with ")
        assert "Cannot open file '/there is/no such file'" in printed
        assert "reads.f, line 8)" in printed


def test_a_missing_language_is_named(prefix, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\nproject(mine LANGUAGES C)\n"
        "find_package(usersub REQUIRED)\nusersub_add_routine(law law.f)\n"
    )
    done = _run("cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}")
    assert done.returncode != 0
    assert "law.f needs the language Fortran" in " ".join(done.stderr.split())


def test_a_static_library_is_refused(tmp_path):
    done = _run("cmake", "-S", _ROOT, "-B", tmp_path, "-DBUILD_SHARED_LIBS=OFF")
    assert done.returncode != 0
    assert "usersub is always a shared library" in " ".join(done.stderr.split())


def test_a_folder_of_the_hosts_project(fortran, tmp_path):
    """add_subdirectory gives the same targets and the function; configured, not built."""
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.20)\nproject(host LANGUAGES C Fortran)\n"
        f'set(BUILD_SHARED_LIBS OFF)\nadd_subdirectory("{_ROOT}" usersub)\n'
        "add_executable(host host.f90)\ntarget_link_libraries(host PRIVATE usersub::fortran)\n"
        "usersub_add_routine(law law.f90)\n"
    )
    (tmp_path / "host.f90").write_text(FORTRAN_HOST)
    (tmp_path / "law.f90").write_text(LAW)
    _done("cmake", "-S", tmp_path, "-B", tmp_path / "build")


@pytest.mark.parametrize("folder", ["lib", "lib/any-linux-gnu"])
def test_pkg_config_where_libraries_have_folders_of_their_own(folder, tmp_path):
    """The prefix is found from the place of the file, however deep it lies."""
    if shutil.which("pkg-config") is None:
        pytest.skip("pkg-config is missing; install it, for example with apt-get")
    _done("cmake", "-S", _ROOT, "-B", tmp_path / "build", f"-DCMAKE_INSTALL_LIBDIR={folder}")
    place = tmp_path / "prefix" / folder / "pkgconfig"
    place.mkdir(parents=True)
    (tmp_path / "prefix/include").mkdir()
    shutil.copy(tmp_path / "build/usersub.pc", place)
    done = _run(
        "pkg-config", "--variable=includedir", "usersub", env={"PKG_CONFIG_PATH": str(place)}
    )
    assert done.returncode == 0, done.stderr
    assert Path(done.stdout.strip()).resolve() == tmp_path / "prefix/include"
