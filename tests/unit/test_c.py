# SPDX-License-Identifier: MIT
"""C and C++ files through the drivers."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest

import usersub
from usersub.routine import c, compilers
from usersub.routine.info import info
from usersub.routine.routine import BLOCK, FULL

_FIELD = Path(__file__).resolve().parents[1] / "field"
_PROPS = [0.4, 0.1, 0.02]


@pytest.mark.parametrize(("precision", "rtol"), [("double", 1e-14), ("single", 1e-6)])
def test_c_law_in_both_precisions(precision, rtol):
    """One rounding of each operation; exp is that of the C library on both sides."""
    real = np.float64 if precision == "double" else np.float32
    routine = usersub.load(_FIELD / "vfric_coef_table.c", precision=precision).only()
    assert routine.entry(precision).style == FULL
    assert routine.thread_safe and routine.language == "c"
    scene = usersub.Scene(points=5, props=_PROPS, precision=precision, nodes=1)
    driver = usersub.CoefficientDriver(routine, scene)
    rate = np.array([0.0, 1.0, 30.0, 200.0, 1e4], dtype=real)
    found = driver.evaluate(slip_rate=rate, pressure=np.ones(5, dtype=real))
    assert found.dtype == real
    np.testing.assert_allclose(found, 0.1 + 0.3 * np.exp(-0.02 * rate.astype(float)), rtol=rtol)


def test_both_precisions_of_one_routine_are_compiled_on_request():
    routine = usersub.load(_FIELD / "vfric_coef_table.c").only()
    assert routine.entry("double").address != routine.entry("single").address


def test_cxx_exception_becomes_a_status_and_a_message():
    said: list[tuple[int, str]] = []
    usersub.messages_to(lambda level, text: said.append((level, text)))
    try:
        routine = usersub.load(_FIELD / "fric_coef_throws.cpp").only()
        assert routine.interface.key == "fric_coef_2022" and routine.entry().style == BLOCK
        scene = usersub.Scene(points=2, props=[0.3, 10.0], interaction="WET CLAY")
        driver = usersub.CoefficientDriver(routine, scene)
        slip = np.zeros((6, 2), order="F")
        slip[0] = [1.0, 2.0]
        found = driver.evaluate(slip_data=slip, pressure=np.array([5.0, 9.0]))
        np.testing.assert_allclose(found, [0.15, 0.15], rtol=1e-15)
        with pytest.raises(usersub.RoutineError):
            driver.evaluate(slip_data=slip, pressure=np.array([5.0, 11.0]))
        assert said == [(-2, "FRIC_COEF raised: pressure above the range, 100  wrong")]
        np.testing.assert_allclose(
            driver.evaluate(pressure=np.array([1.0, 2.0])), [0.15, 0.15], rtol=1e-15
        )
    finally:
        usersub.messages_to()


def test_static_data_keeps_a_routine_to_one_thread():
    routine = usersub.load(_FIELD / "fric_coef_throws.cpp").only()
    assert not routine.thread_safe
    assert info(_FIELD / "fric_coef_throws.cpp").shared_state == ("variable calls",)


def test_compile_error_has_place_and_words(tmp_path):
    source = tmp_path / "law.c"
    source.write_text(
        "#include <omi_for_c.h>\n\nvoid FOR_NAME(fric,FRIC)(int *lm) {  lm = 1 +;\n}\n"
    )
    with pytest.raises(usersub.CompileError, match=r"refused law\.c:\n +law\.c:3:\d+: expected"):
        usersub.load(source)


def test_undeclared_function_is_an_error(tmp_path):
    source = tmp_path / "law.c"
    source.write_text("void fric_(double *x) { *x = helper(*x); }\n")
    with pytest.raises(usersub.CompileError, match="implicit declaration of function 'helper'"):
        usersub.load(source)


def test_missing_compiler_says_how_to_get_one(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    for name in ("CC", "FC"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(compilers.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(usersub.MissingTool, match=r"no C compiler .*`apt install gcc`"):
        usersub.load(_FIELD / "vfric_coef_table.c")
    with pytest.raises(usersub.MissingTool, match=r"no Fortran compiler .*`apt install gfortran`"):
        usersub.load(_FIELD / "fric_char8.f")


def test_environment_names_the_compiler(monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler -m64")
    with pytest.raises(usersub.MissingTool, match="CC names the C compiler 'no-such-compiler'"):
        compilers.find("c")


def test_every_shape_of_hosts_include_compiles_alone(tmp_path):
    """Headers that C users include, in both languages and precisions, without a warning."""
    from usersub.routine.support import support

    for language, suffix in (("c", ".c"), ("c++", ".cpp")):
        compiler = compilers.find(language)
        for precision in ("double", "single"):
            source = tmp_path / f"all{suffix}"
            headers = ("omi_for_c.h", "SMAAspUserSubroutines.h", "usersub/abi.h")
            source.write_text("".join(f"#include <{h}>\n" for h in headers))
            folders = [f"-I{p}" for p in support().include_folders(precision)]
            command = [*compiler.command, *c.flags(language, precision), *folders]
            command += ["-Wall", "-Wextra", "-Werror", "-fsyntax-only", str(source)]
            assert subprocess.run(command).returncode == 0


def test_another_fortran_compiler_in_fc_does_not_hide_gfortran(monkeypatch, tmp_path, fortran):
    other = tmp_path / "ifx"
    other.write_text("#!/bin/sh\necho another compiler 1.0\n")
    other.chmod(0o700)
    monkeypatch.setenv("FC", str(other))
    assert "GNU Fortran" in compilers.find("fortran").version
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(usersub.MissingTool, match="of FC is another compiler"):
        compilers.find("fortran")
