# SPDX-License-Identifier: MIT
"""The public face: every name is there, and nothing is imported that a program does not need."""

from __future__ import annotations

import subprocess
import sys

import pytest

import usersub
from usersub import paths

HEAVY = ("numba", "scipy", "matplotlib", "rich", "click", "elftools", "numpy", "cffi")


def imported(program: str) -> set[str]:
    """Names of the modules that `program` has imported, in a fresh interpreter."""
    program += "\nimport sys; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    return set(done.stdout.split())


@pytest.mark.parametrize("name", usersub.__all__)
def test_every_public_name_is_there(name):
    assert getattr(usersub, name) is not None
    assert name in dir(usersub)


def test_unknown_name():
    with pytest.raises(AttributeError, match="module 'usersub' has no attribute 'vfrik'"):
        usersub.vfrik  # noqa: B018


def test_import_is_light():
    assert not imported("import usersub").intersection(HEAVY)


def test_c_routine_needs_no_numba(tmp_path):
    source = tmp_path / "law.c"
    source.write_text(
        "#include <usersub/abi.h>\n"
        "void vfric_coef_(USUB_VFRIC_COEF_PARAMETERS) {\n"
        "  for (int k = 0; k < *nBlock; ++k) fCoef[k] = slipRate[k];\n}\n"
    )
    modules = imported(
        "import numpy, usersub\n"
        f"law = usersub.load({str(source)!r})['vfric_coef']\n"
        "driver = usersub.CoefficientDriver(law, usersub.Scene(points=2))\n"
        "found = driver.evaluate(slip_rate=numpy.array([1.0, 2.0]), pressure=numpy.ones(2))\n"
        "assert found.tolist() == [1.0, 2.0]"
    )
    assert not modules.intersection({"numba", "scipy", "matplotlib", "rich", "click"})


def test_installed_parts():
    assert (paths.include_folder() / "usersub/usersub.h").is_file()
    assert (paths.include_folder() / "usersub/usersub.f90").is_file()
    assert (paths.cmake_folder() / "usersub-config.cmake").is_file()
    assert (paths.prefix() / "lib/pkgconfig/usersub.pc").is_file()
    assert paths.library_path().is_file()
    assert (paths.reference_impls() / "coulomb").is_dir()


def test_version_is_that_of_the_core():
    from usersub.core import lib, text

    assert text(lib.usub_release()) == usersub.__version__


def test_prepared_call_takes_no_arguments():
    @usersub.vfric_coef(compiled=False)
    def law(fCoef):
        fCoef[:] = 1.0

    call = usersub.CoefficientDriver(law, usersub.Scene()).prepare()
    for arguments, names in (((1,), {}), ((), {"x": 1})):
        with pytest.raises(TypeError, match="takes no arguments"):
            call(*arguments, **names)
