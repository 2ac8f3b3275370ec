# SPDX-License-Identifier: MIT
"""What a program imports: nothing that it does not need."""

from __future__ import annotations

import subprocess
import sys

import pytest

#: Packages that take long to import; none is needed to start.
HEAVY = {
    "numba", "llvmlite", "numpy", "scipy", "matplotlib", "rich", "elftools", "cffi", "dask",
    "distributed", "typer", "pandas", "mpmath",
}  # fmt: skip
#: Slow parts of the standard library.
SLOW = {"asyncio", "concurrent", "multiprocessing", "http", "ssl", "xml", "unittest", "subprocess"}
REPORTS = {"matplotlib", "rich", "dask", "distributed", "scipy", "mpmath"}
COMPILER_OF_PYTHON = {"numba", "llvmlite"}

_COMMAND = """\
import sys
sys.argv = {argv!r}
from usersub.cli import main
try:
    main()
except SystemExit:
    pass
"""
_LAW = """\
import numpy, usersub
law = usersub.laws.exponential_decay(mus=0.3, muk=0.1, dc=2.0).behind({interface!r}, {language!r})
scene = usersub.Scene(points=3, props=[0.3, 0.1, 2.0], nodes=3, characteristic_length=1.0)
"""
_COEFFICIENT = """\
driver = usersub.CoefficientDriver(law, scene)
driver.evaluate(slip_rate=numpy.ones(3), pressure=numpy.ones(3))
driver.plan.explain()
driver.state.save()
"""
_EXPLICIT = """\
slip, normal = numpy.zeros((3, 3), order="F"), numpy.zeros((3, 3), order="F")
slip[0] = normal[2] = 1.0
driver = usersub.ExplicitDriver(law, scene)
driver.step(0.1, slip_increment=slip, normal=normal, normal_force=numpy.ones(3),
            stick_force=numpy.ones(3))
"""
_STANDARD = """\
driver = usersub.StandardDriver(law, scene)
driver.begin_increment(0.1)
driver.iterate(slip_increment=numpy.ones((2, 3), order="F"), pressure=numpy.ones(3))
driver.commit()
"""


def imported(program: str) -> set[str]:
    """Top-level packages that `program` imports, in a fresh interpreter."""
    program += "\nimport sys; print('\\n@modules', *sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return {name.partition(".")[0] for name in done.stdout.rpartition("@modules")[2].split()}


def test_import_of_the_package():
    assert not imported("import usersub") & (
        HEAVY | SLOW | {"click", "platformdirs", "typing_extensions"}
    )


def test_import_of_the_package_loads_no_module_of_its_own():
    program = "import usersub, sys; print([m for m in sys.modules if m.startswith('usersub.')])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    "argv", [["--help"], ["--version"], ["study", "--help"], ["check", "--help"], ["frob"]]
)
def test_help_of_the_command_line(argv):
    assert not imported(_COMMAND.format(argv=["usersub", *argv])) & (HEAVY | SLOW)


@pytest.mark.parametrize("package", ["usersub.check", "usersub.study", "usersub.abi"])
def test_packages_that_only_list_names(package):
    assert not imported(f"import {package}") & (HEAVY - {"numpy"} | SLOW)


@pytest.mark.parametrize("module", ["problems", "study.leaving_out", "driver.costs", "laws"])
def test_modules_that_measure(module):
    assert not imported(f"import usersub.{module}") & (REPORTS | COMPILER_OF_PYTHON)


@pytest.mark.parametrize(
    "language", ["c", pytest.param("fortran", marks=pytest.mark.needs_fortran)]
)
@pytest.mark.parametrize(
    ("interface", "program"),
    [("vfric_coef", _COEFFICIENT), ("vfriction", _EXPLICIT), ("fric", _STANDARD)],
)
def test_compiled_routines_need_no_numba_and_no_reports(interface, program, language):
    program = _LAW.format(interface=interface, language=language) + program
    assert not imported(program) & (REPORTS | COMPILER_OF_PYTHON)


def test_a_prebuilt_pointer_needs_no_compiler(tmp_path):
    program = """\
import ctypes, numpy, usersub
signature = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 16, *[ctypes.c_size_t] * 3)
law = usersub.from_pointer("vfric_coef", signature(lambda *a: None), precision="double")
driver = usersub.CoefficientDriver(law, usersub.Scene(points=2))
driver.evaluate(slip_rate=numpy.ones(2), pressure=numpy.ones(2),)
"""
    assert not imported(program) & (REPORTS | COMPILER_OF_PYTHON | {"elftools"})


def test_a_measured_plan_needs_no_numba_and_no_reports():
    program = _LAW.format(interface="vfric_coef", language="c") + _COEFFICIENT
    program += "print(driver.plan.measure().explain())"
    assert not imported(program) & (REPORTS | COMPILER_OF_PYTHON)
